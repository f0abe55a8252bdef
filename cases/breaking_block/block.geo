// The block, unstructured so that cracks have no preferred direction: gmsh -2 -format msh41 block.geo [-setnumber size 0.016] -o block.msh
DefineConstant[size = 0.016]; // m
width = 0.1; height = 0.32;
Point(1) = {-width / 2, 0, 0, size};
Point(2) = {width / 2, 0, 0, size};
Point(3) = {width / 2, height, 0, size};
Point(4) = {-width / 2, height, 0, size};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("bottom") = {1};
Physical Curve("sides") = {2, 3, 4};
Physical Surface("block") = {1};
Mesh.Algorithm = 5; // Delaunay
