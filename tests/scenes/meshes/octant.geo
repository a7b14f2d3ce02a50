// Eighth of a ball, tetrahedra.
DefineConstant[ h = 0.1 ];
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1, 0, Pi/2, Pi/2};
px() = Surface In BoundingBox{-0.01, -0.01, -0.01, 0.01, 1.01, 1.01};
py() = Surface In BoundingBox{-0.01, -0.01, -0.01, 1.01, 0.01, 1.01};
pz() = Surface In BoundingBox{-0.01, -0.01, -0.01, 1.01, 1.01, 0.01};
all() = Boundary{Volume{1};};
all() -= px();
all() -= py();
all() -= pz();
Physical Surface("px") = {px()};
Physical Surface("py") = {py()};
Physical Surface("pz") = {pz()};
Physical Surface("sphere") = {all()};
Physical Volume("body") = {1};
Mesh.CharacteristicLengthMax = h;
Mesh.CharacteristicLengthMin = h;
