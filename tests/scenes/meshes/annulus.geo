// Disc with a hole beside its middle, quadrilaterals.
DefineConstant[ h = 0.1 ];
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 1};
Disk(2) = {0.1, 0, 0, 0.5};
BooleanDifference(3) = {Surface{1};Delete;}{Surface{2};Delete;};
o() = Curve In BoundingBox{-1.01, -1.01, -1, 1.01, 1.01, 1};
i() = Curve In BoundingBox{-0.45, -0.55, -1, 0.65, 0.55, 1};
o() -= i();
Physical Curve("inner") = {i()};
Physical Curve("outer") = {o()};
Physical Surface("body") = {3};
Mesh.RecombineAll = 1;
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthMax = h;
Mesh.CharacteristicLengthMin = h;
