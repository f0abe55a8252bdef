s = DefineNumber[0.06];
Point(1) = {0, 0, 0, s}; Point(2) = {1.4, 0, 0, s}; Point(3) = {0, 1.4, 0, s};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1};
Curve Loop(1) = {1,2,3}; Plane Surface(1) = {1};
Physical Curve("slope") = {2}; Physical Curve("rest") = {1,3}; Physical Surface("rock") = {1};
