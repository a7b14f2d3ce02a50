// A block with four curved sides, one block of quadrilaterals; sides of about 1 m.
DefineConstant[ h = 0.125 ];
n = Max(2, Round(1/h)) + 1;  // nodes along each side
Point(1) = {-0.5, -0.5, 0};
Point(2) = {0.45, -0.4, 0};
Point(3) = {0.5, 0.5, 0};
Point(4) = {-0.55, 0.4, 0};
Point(5) = {0.0, -0.35, 0};
Point(6) = {0.6, 0.0, 0};
Point(7) = {0.0, 0.6, 0};
Point(8) = {-0.4, 0.0, 0};
BSpline(1) = {1, 5, 2};
BSpline(2) = {2, 6, 3};
BSpline(3) = {3, 7, 4};
BSpline(4) = {4, 8, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1:4} = n;
Transfinite Surface{1};
Recombine Surface{1};
Physical Curve("surface") = {1:4};
Physical Surface("body") = {1};
