// A plate of 1 x 0.5 m, in triangles without a direction of their own: gmsh -2, written as .obj
Point(1) = {0, 0, 0, 0.062}; Point(2) = {1, 0, 0, 0.062}; Point(3) = {1, 0.5, 0, 0.062}; Point(4) = {0, 0.5, 0, 0.062};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Mesh.Algorithm = 5;
