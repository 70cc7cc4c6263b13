#!/usr/bin/python3
"""Reads .vtu files with meshio, independently of rend, and prints their content: one JSON object per line.

Corners of a wedge are in Gmsh's order (which is meshio's); polyhedra are lists of faces.
"""
import json
import sys

import meshio


def plain(value):
    if hasattr(value, "tolist"):
        return value.tolist()
    return [plain(one) for one in value] if isinstance(value, (list, tuple)) else value


for name in sys.argv[1:]:
    mesh = meshio.read(name)
    cells = [[block.type, plain(cell)] for block in mesh.cells for cell in block.data]
    cell_data = {key: [row for block in blocks for row in plain(block)]
                 for key, blocks in mesh.cell_data.items()}
    print(json.dumps({
        "time": float(mesh.field_data["TimeValue"][0]),
        "points": plain(mesh.points),
        "cells": cells,
        "point_data": {key: plain(value) for key, value in mesh.point_data.items()},
        "cell_data": cell_data,
    }, allow_nan=False))
