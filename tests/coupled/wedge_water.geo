// the box of wedge.yaml without the slope, which becomes its lower side
s = DefineNumber[0.15];
Point(1) = {0, 1.4, 0, s}; Point(2) = {1.4, 0, 0, s}; Point(3) = {5, 0, 0, s}; Point(4) = {5, 1.9, 0, s}; Point(5) = {0, 1.9, 0, s};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5}; Line(5) = {5,1};
Curve Loop(1) = {1,2,3,4,5}; Plane Surface(1) = {1};
Rotate {{0,0,1}, {0,1.4,0}, Pi/4} {Surface{1};}
Physical Curve("slope") = {1}; Physical Curve("bottom") = {2}; Physical Curve("right") = {3}; Physical Curve("top") = {4}; Physical Curve("left") = {5};
Physical Surface("water") = {1};
