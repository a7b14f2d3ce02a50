// The unit cube in tetrahedra, ten times smaller in the tenth of it at x = 0.
DefineConstant[ h = 0.2 ];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Field[1] = Box;
Field[1].VIn = h / 10;
Field[1].VOut = h;
Field[1].XMin = -1;
Field[1].XMax = 0.1;
Field[1].YMin = -1;
Field[1].YMax = 2;
Field[1].ZMin = -1;
Field[1].ZMax = 2;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Physical Volume("body") = {1};
