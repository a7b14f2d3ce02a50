// Round rod along x, tetrahedra.
DefineConstant[ h = 0.1 ];
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 1, 0, 0, 0.25};
l() = Surface In BoundingBox{-0.01, -1, -1, 0.01, 1, 1};
r() = Surface In BoundingBox{0.99, -1, -1, 1.01, 1, 1};
s() = Boundary{Volume{1};};
Physical Surface("left") = {l()};
Physical Surface("right") = {r()};
Physical Surface("side") = {1};
Physical Volume("body") = {1};
Mesh.CharacteristicLengthMax = h;
Mesh.CharacteristicLengthMin = h;
