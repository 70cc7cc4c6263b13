// A pane of tetrahedra, one layer thick, which follow no lines.
//
//   gmsh pane.geo -3 -format msh41 -bin -o pane.msh
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.065, thickness = 0.02 ];
Rectangle(1) = {-0.6, -0.45, 0, 1.2, 0.9};
out[] = Extrude {0, 0, thickness} { Surface{1}; Layers{1}; };
Physical Volume("pane") = {out[1]};
Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = size;
Mesh.Algorithm = 6;
General.NumThreads = 1;
