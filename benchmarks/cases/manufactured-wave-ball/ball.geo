// Ball of radius 1/2 about (1/2, 1/2, 1/2) in unstructured tetrahedra.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.25 ];
Sphere(1) = {0.5, 0.5, 0.5, 0.5};
MeshSize{:} = h;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Physical Surface("surface") = {1};
Physical Volume("body") = {1};
