// One eighth of a stent-like tube: radii 9 and 10 mm, cut into a lattice by staggered diamonds, eight
// around. Symmetry planes x = 0, y = 0, z = 0; free at the other end. Tetrahedra.
DefineConstant[ h = 0.8e-3 ];
SetFactory("OpenCASCADE");
r = 9e-3;
R = 10e-3;
a = Pi*(r + R)/8;          // pitch around, at the middle of the wall, and along
strut = 1.4e-3;
s = a/Sqrt(2) - strut;     // side of a diamond
Cylinder(1) = {0, 0, 0, 0, 0, a, R, Pi/2};
Cylinder(2) = {0, 0, -a, 0, 0, 3*a, r, 2*Pi};
n = 10;
holes[] = {2};
For j In {0:2}
  For i In {0:2}
    angle = (i + (j == 1 ? 0.5 : 0))*Pi/4;
    If (angle < 0.51*Pi)
      Box(n) = {0, -s/2, -s/2, 2*R, s, s};
      Rotate {{1, 0, 0}, {0, 0, 0}, Pi/4} { Volume{n}; }
      Translate {0, 0, j*a/2} { Volume{n}; }
      Rotate {{0, 0, 1}, {0, 0, 0}, angle} { Volume{n}; }
      holes[] += {n};
      n += 1;
    EndIf
  EndFor
EndFor
body[] = BooleanDifference{ Volume{1}; Delete; }{ Volume{holes[]}; Delete; };
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromPoints = 0;
e = 1e-6;
Physical Surface("inside") = Surface In BoundingBox{-e, -e, -e, r + e, r + e, a + e};
Physical Surface("plane_x") = Surface In BoundingBox{-e, -e, -e, e, R + e, a + e};
Physical Surface("plane_y") = Surface In BoundingBox{-e, -e, -e, R + e, e, a + e};
Physical Surface("plane_z") = Surface In BoundingBox{-e, -e, -e, R + e, R + e, e};
Physical Volume("body") = body[];
