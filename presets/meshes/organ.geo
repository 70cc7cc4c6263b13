// A soft organ of our own, about 0.2 m long: a bent, tapered blob, thick near its base and thin at its tip, flatter
// below than above. It is spanned smoothly over ellipses that stand across an arc.
//
//   gmsh organ.geo -3 -setnumber size 0.0228 -format msh41 -bin -o organ-600.msh      about 600 tetrahedra
//   gmsh organ.geo -3 -setnumber size 0.0062 -format msh41 -bin -o organ-20k.msh     about 20,000
//
// Physical groups: organ, all of it; base, the flat end by which it hangs; tip, the other end.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.0228 ];

// Along the arc: half widths across it, in its plane and out of it [m].
sections = 8;
wide() = {0.030, 0.046, 0.056, 0.058, 0.052, 0.041, 0.027, 0.012};
high() = {0.022, 0.036, 0.043, 0.041, 0.034, 0.025, 0.016, 0.008};
radius = 0.13;       // of the arc [m]
span = 95 * Pi / 180; // that it turns by

For n In {0 : sections - 1}
  a = span * n / (sections - 1);
  Ellipse(100 + n) = {0, 0, 0, wide(n), high(n)};
  // from the xy plane to the plane through the z axis, then along the arc; the middle sinks, which flattens it below
  Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 2} { Curve{100 + n}; }
  Translate {radius, 0, 0.2 * (high(n) - high(0))} { Curve{100 + n}; }
  Rotate {{0, 0, 1}, {0, 0, 0}, a} { Curve{100 + n}; }
  Curve Loop(200 + n) = {100 + n};
EndFor
ThruSections(1) = {200 : 200 + sections - 1};

Physical Volume("organ") = {1};
Physical Surface("base") = Surface In BoundingBox {0, -0.001, -1, 1, 0.001, 1};
c = Cos(span); s = Sin(span);
Physical Surface("tip") = Surface In BoundingBox {radius * c - 0.02, radius * s - 0.02, -1, radius * c + 0.02, radius * s + 0.02, 1};

Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = size / 3;
Mesh.MeshSizeFromPoints = 0;
Mesh.Optimize = 1;
General.NumThreads = 1;
