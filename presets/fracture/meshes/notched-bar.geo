// A bar 0.5 m long, 0.16 m high and 0.1 m thick with a notch 0.04 m deep in the middle of its upper face. Finer
// around the notch and below it, where it is to part; five to six tetrahedra across the thickness there.
//
//   gmsh notched-bar.geo -3 -format msh22 -o notched-bar.msh
Point(1) = {-0.25, 0, 0};       Point(2) = {0.25, 0, 0};        Point(3) = {0.25, 0, 0.16};
Point(4) = {0.01, 0, 0.16};     Point(5) = {0, 0, 0.12};        Point(6) = {-0.01, 0, 0.16};
Point(7) = {-0.25, 0, 0.16};
For n In {1 : 6}
  Line(n) = {n, n + 1};
EndFor
Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};
Plane Surface(1) = {1};
Extrude {0, 0.1, 0} { Surface{1}; }
Physical Volume("bar") = {1};

Field[1] = MathEval;
Field[1].F = "0.018 + 0.15 * Max(Abs(x) - 0.04, 0)";
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Optimize = 1;
General.NumThreads = 1;
