// A disc of radius 0.5 m: a square of quadrilaterals within four blocks.
DefineConstant[ h = 0.0625 ];
a = 0.22;
b = 0.5*Sqrt(0.5);
n = Max(2, Round(0.5/h)) + 1;
m = Max(2, Round(0.25/h)) + 1;
Point(1) = {0, 0, 0};
Point(2) = {-a, -a, 0};
Point(3) = {a, -a, 0};
Point(4) = {a, a, 0};
Point(5) = {-a, a, 0};
Point(6) = {-b, -b, 0};
Point(7) = {b, -b, 0};
Point(8) = {b, b, 0};
Point(9) = {-b, b, 0};
For k In {0:3}
  next = (k + 1) % 4;
  Line(1 + k) = {2 + k, 2 + next};
  Circle(5 + k) = {6 + k, 1, 6 + next};
  Line(9 + k) = {2 + k, 6 + k};
EndFor
Curve Loop(5) = {1:4};
Plane Surface(5) = {5};
For k In {0:3}
  next = (k + 1) % 4;
  Curve Loop(1 + k) = {9 + k, 5 + k, -(9 + next), -(1 + k)};
  Plane Surface(1 + k) = {1 + k};
EndFor
Transfinite Curve{1:8} = n;
Transfinite Curve{9:12} = m;
Transfinite Surface{1:5};
Recombine Surface{1:5};
Physical Curve("surface") = {5:8};
Physical Surface("body") = {1:5};
