// A duct of 16 mm x 16 mm, 60 mm high; gas enters through the lower 12 mm of one side.
//   gmsh -3 -format msh22 side-inlet.geo
a = 0.008; n = 4;
Point(1) = {-a, -a, 0}; Point(2) = {a, -a, 0}; Point(3) = {a, a, 0}; Point(4) = {-a, a, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = n + 1; Transfinite Surface {1}; Recombine Surface {1};
low[]  = Extrude {0, 0, 0.012} { Surface{1}; Layers{3}; Recombine; };
high[] = Extrude {0, 0, 0.048} { Surface{low[0]}; Layers{12}; Recombine; };
// low[2..5] are the sides over the lines 1 to 4; that over line 2 is at x = a.
Physical Volume("vessel") = {low[1], high[1]};
Physical Surface("bottom") = {1};
Physical Surface("top")    = {high[0]};
Physical Surface("side")   = {low[3]};
Physical Surface("wall")   = {low[2], low[4], low[5], high[2], high[3], high[4], high[5]};
