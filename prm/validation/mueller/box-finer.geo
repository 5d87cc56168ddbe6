// A box of 44 mm x 10 mm, 120 mm high, in 8 x 1 x 20 cells that are halved further.
//   gmsh -3 -format msh22 box-finer.geo
x = 0.022; y = 0.005;
Point(1) = {-x, -y, 0}; Point(2) = {x, -y, 0}; Point(3) = {x, y, 0}; Point(4) = {-x, y, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 9; Transfinite Curve {2, 4} = 2;
Transfinite Surface {1}; Recombine Surface {1};
box[] = Extrude {0, 0, 0.120} { Surface{1}; Layers{20}; Recombine; };
Physical Volume("vessel") = {box[1]};
Physical Surface("bottom") = {1};
Physical Surface("top")    = {box[0]};
Physical Surface("wall")   = {box[2], box[3], box[4], box[5]};
