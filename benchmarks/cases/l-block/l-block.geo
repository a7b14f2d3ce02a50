// L-shaped block: (0..6) x (0..3) and (0..3) x (0..10) m, 3 m thick, in three boxes of hexahedra.
DefineConstant[ h = 1 ];
n3 = Max(1, Round(3/h)) + 1;  // nodes along 3 m
n7 = Max(1, Round(7/h)) + 1;  // nodes along 7 m
Point(1) = {0, 0, 0};
Point(2) = {3, 0, 0};
Point(3) = {6, 0, 0};
Point(4) = {6, 3, 0};
Point(5) = {3, 3, 0};
Point(6) = {0, 3, 0};
Point(7) = {3, 10, 0};
Point(8) = {0, 10, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Line(8) = {5, 7};
Line(9) = {7, 8};
Line(10) = {8, 6};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Curve Loop(3) = {-5, 8, 9, 10};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Transfinite Curve{1, 2, 3, 4, 5, 6, 7, 9} = n3;
Transfinite Curve{8, 10} = n7;
Transfinite Surface{1, 2, 3};
Recombine Surface{1, 2, 3};
corner[] = Extrude {0, 0, 3} { Surface{1}; Layers{n3 - 1}; Recombine; };
foot[] = Extrude {0, 0, 3} { Surface{2}; Layers{n3 - 1}; Recombine; };
leg[] = Extrude {0, 0, 3} { Surface{3}; Layers{n3 - 1}; Recombine; };
Physical Surface("foot_end") = {foot[3]};
Physical Surface("leg_end") = {leg[4]};
Physical Volume("body") = {corner[1], foot[1], leg[1]};
