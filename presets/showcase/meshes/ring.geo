// A ring with a round section.
//
//   gmsh ring.geo -3 -format msh41 -bin -o ring.msh
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.034 ];
Torus(1) = {0, 0, 0, 0.15, 0.055};
Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = size;
Mesh.Optimize = 1;
General.NumThreads = 1;
