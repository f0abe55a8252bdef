s = DefineNumber[0.04];
Point(1) = {0.41, 0.99, 0, s}; Point(2) = {0.91, 0.49, 0, s}; Point(3) = {0.91, 0.99, 0, s};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1};
Curve Loop(1) = {1,2,3}; Plane Surface(1) = {1};
DefineConstant[turned = 0]; Rotate {{0,0,1}, {0,1.4,0}, turned*Pi/4} {Surface{1};}
Physical Curve("slide") = {1}; Physical Curve("front") = {2}; Physical Curve("top") = {3}; Physical Surface("wedge") = {1};
