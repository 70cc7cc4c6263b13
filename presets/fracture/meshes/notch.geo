// A plate 1 m wide, 0.6 m high and 0.05 m thick with a notch 0.12 m deep in the middle of its upper edge.
// Finer around the notch and below it, where it is to tear; one or two tetrahedra across the thickness.
//
//   gmsh notch.geo -3 -format msh22 -o notch.msh
Point(1) = {-0.5, 0, 0};        Point(2) = {0.5, 0, 0};         Point(3) = {0.5, 0, 0.6};
Point(4) = {0.03, 0, 0.6};      Point(5) = {0, 0, 0.48};        Point(6) = {-0.03, 0, 0.6};
Point(7) = {-0.5, 0, 0.6};
For n In {1 : 6}
  Line(n) = {n, n + 1};
EndFor
Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};
Plane Surface(1) = {1};
Extrude {0, 0.05, 0} { Surface{1}; }
Physical Volume("plate") = {1};

Field[1] = MathEval;
Field[1].F = "0.036 + 0.09 * Max(Abs(x) - 0.06, 0)";
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Optimize = 1;
General.NumThreads = 1;
