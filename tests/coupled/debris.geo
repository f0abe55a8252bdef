// A stone of 9 cm, triangles of 2 cm.
h = 0.022;
Point(1) = {-0.04, -0.03, 0, h};
Point(2) = {0.035, -0.04, 0, h};
Point(3) = {0.045, 0.02, 0, h};
Point(4) = {0, 0.045, 0, h};
Point(5) = {-0.045, 0.02, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Surface("stone") = {1};
