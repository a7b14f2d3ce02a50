// A top: cone, disc and stem about an axis tilted by 15 degrees, standing on its tip (radius 4 mm).
DefineConstant[ h = 12e-3 ];
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0};
Point(2) = {4e-3, 0, 0};
Point(3) = {60e-3, 0, 50e-3};
Point(4) = {60e-3, 0, 70e-3};
Point(5) = {12e-3, 0, 70e-3};
Point(6) = {12e-3, 0, 110e-3};
Point(7) = {0, 0, 110e-3};
For k In {1:6}
  Line(k) = {k, k + 1};
EndFor
Line(7) = {7, 1};
Curve Loop(1) = {1:7};
Plane Surface(1) = {1};
top[] = Extrude {{0, 0, 1}, {0, 0, 0}, 2*Pi} { Surface{1}; };
Rotate {{0, 1, 0}, {0, 0, 0}, Pi/12} { Volume{top[1]}; }
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromPoints = 0;
skin() = Boundary{ Volume{top[1]}; };
Physical Surface("skin") = {skin()};
Physical Volume("body") = {top[1]};
