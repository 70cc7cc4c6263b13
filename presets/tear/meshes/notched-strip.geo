// A strip of 0.8 x 0.4 m with a round notch of radius 0.04 m in the middle of its upper edge.
// gmsh -2 -clscale 1 (notched-strip.obj) or 0.5 (notched-strip-fine.obj), written as .obj
L = 0.8; W = 0.4; r = 0.04;
at = 0.005; path = 0.018; far = 0.045;
Point(1) = {0, 0, 0, far};
Point(2) = {L / 2, 0, 0, path};
Point(3) = {L, 0, 0, far};
Point(4) = {L, W, 0, far};
Point(5) = {L / 2 + r, W, 0, at};
Point(6) = {L / 2, W - r, 0, at};
Point(7) = {L / 2 - r, W, 0, at};
Point(8) = {0, W, 0, far};
Point(9) = {L / 2, W, 0, at};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Circle(5) = {5, 9, 6}; Circle(6) = {6, 9, 7};
Line(7) = {7, 8}; Line(8) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};
Mesh.Algorithm = 6;
