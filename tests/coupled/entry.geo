// A wedge of this deadrise angle, degrees, and half width, m, whose apex is 5 mm above the water.
DefineConstant[deadrise = 30]; DefineConstant[half = 0.4];
low = 0.005; high = low + half*Tan(deadrise*Pi/180); s = 0.04;
Point(1) = {0, low, 0, s}; Point(2) = {half, high, 0, s}; Point(3) = {-half, high, 0, s};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1};
Curve Loop(1) = {1,2,3}; Plane Surface(1) = {1};
Physical Curve("right") = {1}; Physical Curve("top") = {2}; Physical Curve("left") = {3}; Physical Surface("wedge") = {1};
