// Plate with a hole, triangles.
DefineConstant[ h = 0.1 ];
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 0.6};
Disk(2) = {0.5, 0.3, 0, 0.15};
BooleanDifference(3) = {Surface{1};Delete;}{Surface{2};Delete;};
l() = Curve In BoundingBox{-0.01, -0.01, -1, 0.01, 0.61, 1};
r() = Curve In BoundingBox{0.99, -0.01, -1, 1.01, 0.61, 1};
b() = Curve In BoundingBox{-0.01, -0.01, -1, 1.01, 0.01, 1};
t() = Curve In BoundingBox{-0.01, 0.59, -1, 1.01, 0.61, 1};
ho() = Curve In BoundingBox{0.3, 0.1, -1, 0.7, 0.5, 1};
Physical Curve("left") = {l()};
Physical Curve("right") = {r()};
Physical Curve("rest") = {b(), t()};
Physical Curve("hole") = {ho()};
Physical Surface("body") = {3};
Mesh.CharacteristicLengthMax = h;
Mesh.CharacteristicLengthMin = h;
