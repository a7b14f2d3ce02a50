// A tube about z of four quarters of hexahedra; radii 0.25 and 0.5 m, 0.5 m long.
DefineConstant[ h = 0.125 ];
r = 0.25;
R = 0.5;
n_wall = Max(2, Round((R - r)/h)) + 1;       // nodes through the wall
n_arc = Max(2, Round(Pi*(R + r)/4/h)) + 1;   // nodes along a quarter
n_long = Max(2, Round(0.5/h));               // cells along the axis
z = -0.25;
Point(1) = {0, 0, z};
Point(2) = {r, 0, z};
Point(3) = {0, r, z};
Point(4) = {-r, 0, z};
Point(5) = {0, -r, z};
Point(6) = {R, 0, z};
Point(7) = {0, R, z};
Point(8) = {-R, 0, z};
Point(9) = {0, -R, z};
For k In {0:3}
  next = (k + 1) % 4;
  Circle(1 + k) = {2 + k, 1, 2 + next};
  Circle(5 + k) = {6 + k, 1, 6 + next};
  Line(9 + k) = {2 + k, 6 + k};
EndFor
For k In {0:3}
  next = (k + 1) % 4;
  Curve Loop(1 + k) = {9 + k, 5 + k, -(9 + next), -(1 + k)};
  Plane Surface(1 + k) = {1 + k};
EndFor
Transfinite Curve{1:8} = n_arc;
Transfinite Curve{9:12} = n_wall;
Transfinite Surface{1:4};
Recombine Surface{1:4};
Extrude {0, 0, 0.5} { Surface{1:4}; Layers{n_long}; Recombine; }
Physical Volume("body") = {1:4};
Physical Surface("surface") = CombinedBoundary{ Volume{1:4}; };
