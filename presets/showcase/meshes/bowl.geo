// A bowl of tetrahedra, one layer thick: a curve turned about the z axis, which grows by its thickness.
//
//   gmsh bowl.geo -3 -format msh41 -bin -o bowl.msh
DefineConstant[ size = 0.026, thickness = 0.009 ];

Point(1) = {0, 0, 0}; Point(2) = {0.05, 0, 0.006}; Point(3) = {0.1, 0, 0.042}; Point(4) = {0.128, 0, 0.1};
Spline(1) = {1, 2, 3, 4};
curve = 1;
For n In {0 : 3}
  out[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Curve{curve}; };
  curve = out[0];
  side[n] = out[1];
EndFor
wall[] = Extrude { Surface{side[]}; Layers{1, thickness}; Using Index[0]; };

Physical Volume("bowl") = Volume{:};
Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = size;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 6;
General.NumThreads = 1;
