// The unit cube in tetrahedra without order, a group for each face.
DefineConstant[ h = 0.2 ];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
e = 1e-6;
Physical Surface("x_min") = Surface In BoundingBox{-e, -e, -e, e, 1 + e, 1 + e};
Physical Surface("x_max") = Surface In BoundingBox{1 - e, -e, -e, 1 + e, 1 + e, 1 + e};
Physical Surface("y_min") = Surface In BoundingBox{-e, -e, -e, 1 + e, e, 1 + e};
Physical Surface("y_max") = Surface In BoundingBox{-e, 1 - e, -e, 1 + e, 1 + e, 1 + e};
Physical Surface("z_min") = Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e};
Physical Surface("z_max") = Surface In BoundingBox{-e, -e, 1 - e, 1 + e, 1 + e, 1 + e};
Physical Volume("body") = {1};
