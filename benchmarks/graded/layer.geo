// The unit cube in hexahedra: two cells of a tenth of the others' thickness at x = 0, as of a coating.
DefineConstant[ h = 0.1 ];
SetFactory("OpenCASCADE");
n = Max(2, Round(1 / h));
Rectangle(1) = {0, 0, 0, h / 5, 1};
Rectangle(2) = {h / 5, 0, 0, 1 - h / 5, 1};
Coherence;
Transfinite Curve{:} = n + 1;
thin[] = Curve In BoundingBox{-1e-6, -1e-6, -1e-6, h / 5 + 1e-6, 1e-6, 1e-6};
thin[] += Curve In BoundingBox{-1e-6, 1 - 1e-6, -1e-6, h / 5 + 1e-6, 1 + 1e-6, 1e-6};
Transfinite Curve{thin[]} = 3;
Transfinite Surface{:};
Recombine Surface{:};
Extrude {0, 0, 1} { Surface{:}; Layers{n}; Recombine; }
Physical Volume("body") = Volume{:};
