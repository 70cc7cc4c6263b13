#!/usr/bin/env python3
"""The waisted bar of pulled-bar.xml: boxes, 1.2 m long, 0.24 m wide, narrowed in the middle. Writes .msh 2.2.

   python3 waist.py 36 6 > waist.msh       boxes along and across; optionally how much
                                           narrower (0.4), over what length (0.16)
"""
import sys, math
n, m = int(sys.argv[1]), int(sys.argv[2])
depth, length = (float(a) for a in (sys.argv[3:5] or ("0.4", "0.16")))
print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d" % ((n + 1) * (m + 1) ** 2))
at = lambda i, j, k: 1 + i + (n + 1) * (j + (m + 1) * k)
for k in range(m + 1):
    for j in range(m + 1):
        for i in range(n + 1):
            x = 1.2 * i / n - 0.6
            w = 0.24 * (1 - depth * math.exp(-(x / length) ** 2))
            print(at(i, j, k), "%.6g %.6g %.6g" % (x, w * (j / m - 0.5), w * (k / m - 0.5)))
print("$EndNodes\n$Elements\n%d" % (n * m * m))
e = 0
for k in range(m):
    for j in range(m):
        for i in range(n):
            e += 1
            c = [at(i, j, k), at(i+1, j, k), at(i+1, j+1, k), at(i, j+1, k),
                 at(i, j, k+1), at(i+1, j, k+1), at(i+1, j+1, k+1), at(i, j+1, k+1)]
            print(e, 5, 2, 1, 1, *c)
print("$EndElements")
