// A quarter of a thin-walled tube, outer radius 0.1 m, height 0.1139 m; hexahedra of one size in all
// directions.
DefineConstant[ h = 4e-3 ];
t = 4e-3;
R = 0.1;
r = R - t;
H = 0.1139;
n_wall = Max(1, Round(t/h)) + 1;        // nodes through the wall
n_arc = Max(3, Round(Pi*R/2/h)) + 1;      // nodes along the quarter
n_high = Max(3, Round(H/h));              // layers
Point(1) = {0, 0, 0};
Point(2) = {r, 0, 0};
Point(3) = {R, 0, 0};
Point(4) = {0, R, 0};
Point(5) = {0, r, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = n_wall;
Transfinite Curve{2, 4} = n_arc;
Transfinite Surface{1};
Recombine Surface{1};
tube[] = Extrude {0, 0, H} { Surface{1}; Layers{n_high}; Recombine; };
Physical Surface("bottom") = {1};
Physical Surface("top") = {tube[0]};
Physical Surface("plane_y") = {tube[2]};
Physical Surface("outside") = {tube[3]};
Physical Surface("plane_x") = {tube[4]};
Physical Surface("inside") = {tube[5]};
Physical Volume("body") = {tube[1]};
