// A box of 50.8 mm x 50.8 mm, 203.2 mm high, in four cubes that are halved further.
//   gmsh -3 -format msh22 box.geo
a = 0.0254;
Point(1) = {-a, -a, 0}; Point(2) = {a, -a, 0}; Point(3) = {a, a, 0}; Point(4) = {-a, a, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = 2; Transfinite Surface {1}; Recombine Surface {1};
box[] = Extrude {0, 0, 0.2032} { Surface{1}; Layers{4}; Recombine; };
Physical Volume("vessel") = {box[1]};
Physical Surface("bottom") = {1};
Physical Surface("top")    = {box[0]};
Physical Surface("wall")   = {box[2], box[3], box[4], box[5]};
