// A unit square with a square hole, in two physical surfaces; the right side has no name.  Written by
//   for f in 22 41; do gmsh -2 -format msh$f square_hole.geo -o square_hole_$f.msh
//                      gmsh -2 -bin -format msh$f square_hole.geo -o square_hole_${f}_binary.msh; done
Point(1) = {0, 0, 0, 0.5};     Point(2) = {1, 0, 0, 0.5};     Point(3) = {1, 1, 0, 0.5};     Point(4) = {0, 1, 0, 0.5};
Point(5) = {0.4, 0.4, 0, 0.2}; Point(6) = {0.6, 0.4, 0, 0.2}; Point(7) = {0.6, 0.6, 0, 0.2}; Point(8) = {0.4, 0.6, 0, 0.2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Line(9) = {1, 5}; Line(10) = {3, 7};
Curve Loop(1) = {1, 2, 10, -6, -5, -9};
Curve Loop(2) = {3, 4, 9, -8, -7, -10};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Reverse Surface{2};
Physical Curve("bottom") = {1};
Physical Curve("top and left") = {3, 4};
Physical Curve("hole") = {5, 6, 7, 8};
Physical Curve("seam") = {9};
Physical Surface("right part") = {1};
Physical Surface("left part") = {2};
