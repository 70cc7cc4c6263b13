#!/usr/bin/python3
"""Reads an .obj file and its material library by their specification, and prints them as JSON:
{"library": name, "materials": {name: {"Kd": [r, g, b], "map_Kd": file}},
 "faces": [{"object", "material", "points": [[x, y, z]], "places": [[u, v]] or null}]}"""
import json
import os
import sys


def materials_of(path):
    found = {}
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            head, _, rest = line.rstrip("\n").partition(" ")
            if head == "newmtl":
                here = found[rest] = {}
            elif head == "Kd":
                here[head] = [float(word) for word in rest.split()]
            elif head == "map_Kd":
                here[head] = rest
            else:
                raise SystemExit("an unknown statement: " + line)
    return found


def main(path):
    points, places, faces = [], [], []
    out = {"library": None, "materials": {}, "faces": faces}
    name = material = None
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            head, *words = line.split()
            if head == "v":
                points.append([float(word) for word in words])
            elif head == "vt":
                places.append([float(word) for word in words])
            elif head == "o":
                name = words[0]
            elif head == "usemtl":
                material = words[0]
            elif head == "mtllib":
                out["library"] = words[0]
                out["materials"] = materials_of(os.path.join(os.path.dirname(path), words[0]))
            elif head == "f":
                corners = [[int(part) for part in word.split("/")] for word in words]
                assert all(number > 0 for corner in corners for number in corner)
                assert len({len(corner) for corner in corners}) == 1, line
                faces.append({
                    "object": name,
                    "material": material,
                    "points": [points[corner[0] - 1] for corner in corners],
                    "places": [places[corner[1] - 1] for corner in corners] if len(corners[0]) > 1 else None,
                })
    json.dump(out, sys.stdout)


main(sys.argv[1])
