// A ring about the origin in four quarters of quadrilaterals; radii 0.25 and 0.5 m.
DefineConstant[ h = 0.0625 ];
r = 0.25;
R = 0.5;
n_wall = Max(2, Round((R - r)/h)) + 1;
n_arc = Max(3, Round(Pi*(R + r)/4/h)) + 1;
Point(1) = {0, 0, 0};
Point(2) = {r, 0, 0};
Point(3) = {0, r, 0};
Point(4) = {-r, 0, 0};
Point(5) = {0, -r, 0};
Point(6) = {R, 0, 0};
Point(7) = {0, R, 0};
Point(8) = {-R, 0, 0};
Point(9) = {0, -R, 0};
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
Physical Curve("surface") = {1:8};
Physical Surface("body") = {1:4};
