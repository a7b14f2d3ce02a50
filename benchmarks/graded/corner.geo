// The unit cube in tetrahedra, ten times smaller within h/2 of the corner at the origin.
DefineConstant[ h = 0.2 ];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Field[1] = MathEval;
Field[1].F = Sprintf("%g*max(0.1, min(1, sqrt(x*x + y*y + z*z) - %g + 0.1))", h, h / 2);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Physical Volume("body") = {1};
