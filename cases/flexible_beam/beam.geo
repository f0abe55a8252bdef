// Cylinder and flexible beam of Turek and Hron (2006), one body: gmsh -2 -format msh41 beam.geo [-setnumber layers 8] -o beam.msh
// The beam's triangles are structured, `layers` through its thickness; the cylinder, which is held, is as coarse as its boundary allows.
DefineConstant[layers = 4];
length = 0.35; thickness = 0.02; radius = 0.05; x = 0.2; y = 0.2; // m
size = thickness / layers;
root = x + Sqrt(radius^2 - (thickness / 2)^2);       // where the beam's faces leave the cylinder
tip = x + radius + length;
n = Round((tip - root) / size);
Point(1) = {x, y, 0};
Point(2) = {root, y - thickness / 2, 0}; Point(3) = {tip, y - thickness / 2, 0};
Point(4) = {tip, y + thickness / 2, 0}; Point(5) = {root, y + thickness / 2, 0};
Point(6) = {x, y + radius, 0}; Point(7) = {x - radius, y, 0}; Point(8) = {x, y - radius, 0};
Line(1) = {2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Circle(4) = {2, 1, 5}; // 4: the arc inside the body
Circle(5) = {5, 1, 6}; Circle(6) = {6, 1, 7}; Circle(7) = {7, 1, 8}; Circle(8) = {8, 1, 2};
Curve Loop(1) = {1, 2, 3, -4}; Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 6, 7, 8}; Plane Surface(2) = {2};
Transfinite Curve {1, 3} = n + 1; Transfinite Curve {2, 4} = layers + 1;
Transfinite Surface {1} Alternated;
arc = Round(Pi / 2 * radius / (1.5 * size));
If (arc < 14)
  arc = 14;
EndIf
Transfinite Curve {5, 6, 7, 8} = arc + 1;
Physical Curve("cylinder") = {5, 6, 7, 8};

Physical Curve("beam") = {1, 2, 3};
Physical Surface("beam") = {1};
Physical Surface("cylinder") = {2};
