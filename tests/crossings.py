#!/usr/bin/env python3
"""Counts where surfaces go through each other, in every frame of a run, from its exported files alone.

    tests/crossings.py REND PRESET... [--set PATH=VALUE]... [--steps N] [--expect N]
    tests/crossings.py --self-test

A crossing is an edge of one face that passes through another face, both in full precision: its ends lie on
either side of the plane of the face, each at least 1e-9 of the scene's size away from it, and it meets the
plane within the face, as far from its sides. Faces and edges that share a vertex are left out, and so are
pairs that no <contact> asks for: those within a fragment without `self`, those of bodies without `fragments`
and, with spheres, boxes and meshes, without `obstacles`. Polygons are taken as the triangles around their first
corner.

Prints for each preset: frames, frames with crossings, crossings in all, the most in one frame. Exits 1 if there
are more in all than --expect says (default: any number may be).
"""
import argparse
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

OFF = 1e-9  # of the size of the scene
TYPES = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
         "float": "<f4", "double": "<f8"}


class Skin:
    """Points [m], triangles as three points each, and of each triangle its body and its fragment."""

    def __init__(self, points, triangles, body, fragment, names=()):
        self.points, self.triangles = np.asarray(points, float), np.asarray(triangles, int).reshape(-1, 3)
        self.body, self.fragment, self.names = np.asarray(body), np.asarray(fragment), list(names)


def header_of(file):
    names, elements = {}, []
    for line in iter(file.readline, b"end_header\n"):
        word, *rest = line.decode().split()
        if word == "comment" and rest[0] == "body":
            names[int(rest[1])] = rest[3]
        elif word == "element":
            elements.append((rest[0], int(rest[1]), []))
        elif word == "property":
            elements[-1][2].append(rest)
    return [names[n] for n in sorted(names)], elements


def read_ply(path):
    with open(path, "rb") as file:
        names, elements = header_of(file)
        data = file.read()
    (_, count, properties), (_, faces, of_face) = elements[:2]
    row = np.dtype([(words[-1], TYPES[words[0]]) for words in properties])
    table = np.frombuffer(data, row, count)
    points = np.stack([table["x"], table["y"], table["z"]], axis=1)
    at = count * row.itemsize
    rest = np.dtype([(words[-1], TYPES[words[0]]) for words in of_face if words[0] != "list"])
    assert of_face[0][:3] == ["list", "uchar", "int"]
    triangles, body, fragment = [], [], []
    for _ in range(faces):
        sides = data[at]
        corners = np.frombuffer(data, "<i4", sides, at + 1)
        values = np.frombuffer(data, rest, 1, at + 1 + 4 * sides)[0]
        at += 1 + 4 * sides + rest.itemsize
        for k in range(1, sides - 1):
            triangles.append((corners[0], corners[k], corners[k + 1]))
            body.append(values["body"])
            fragment.append(values["fragment"])
    assert at == len(data), "bytes behind the last face"
    return Skin(points, triangles, body, fragment, names)


def edges_of(skin):
    """Each edge once, with one of its triangles."""
    sides = np.concatenate([skin.triangles[:, [0, 1]], skin.triangles[:, [1, 2]], skin.triangles[:, [2, 0]]])
    owner = np.tile(np.arange(len(skin.triangles)), 3)
    _, first = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)
    return sides[first], owner[first]


def near_pairs(skin, edges):
    """Indices of edges and triangles whose bounding spheres meet."""
    ends, corners = skin.points[edges], skin.points[skin.triangles]
    middle, centre = ends.mean(axis=1), corners.mean(axis=1)
    half = np.linalg.norm(ends[:, 0] - middle, axis=1)
    radius = np.linalg.norm(corners - centre[:, None], axis=2).max(axis=1)
    found = []
    # Spheres of like size are looked for together, or a large one would find everything.
    grade = np.floor(np.log2(np.maximum(radius, 1e-300)))
    for one in np.unique(grade):
        which = np.flatnonzero(grade == one)
        tree = cKDTree(centre[which])
        most = radius[which].max()
        for n, near in enumerate(tree.query_ball_point(middle, half + most)):
            if near:
                found.append(np.stack([np.full(len(near), n), which[near]], axis=1))
    return np.concatenate(found) if found else np.zeros((0, 2), int)


def crossings(skin, asked=None):
    """How many edges pass through triangles. asked(body, fragment, other body, its fragment): what counts."""
    if len(skin.triangles) == 0:
        return 0
    edges, owner = edges_of(skin)
    edge, face = near_pairs(skin, edges).T
    ends, corners = edges[edge], skin.triangles[face]
    apart = np.ones(len(edge), bool)
    for k in range(2):
        apart &= (ends[:, k, None] != corners).all(axis=1)
    if asked is not None:
        apart &= asked(skin.body[owner[edge]], skin.fragment[owner[edge]], skin.body[face], skin.fragment[face])
    ends, corners = skin.points[ends[apart]], skin.points[corners[apart]]
    size = np.ptp(skin.points, axis=0).max()
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    across = np.cross(b - a, c - a)
    area = np.linalg.norm(across, axis=1)
    good = area > 0
    normal = np.where(good[:, None], across / np.where(good, area, 1)[:, None], 0)
    low, high = (np.einsum("ij,ij->i", ends[:, k] - a, normal) for k in range(2))
    passes = good & (low * high < 0) & (np.minimum(abs(low), abs(high)) > OFF * size)
    share = np.where(passes, low / np.where(passes, low - high, 1), 0)
    at = ends[:, 0] + share[:, None] * (ends[:, 1] - ends[:, 0])
    for p, q in ((a, b), (b, c), (c, a)):
        side = np.cross(q - p, at - p)
        length = np.linalg.norm(q - p, axis=1)
        inward = np.einsum("ij,ij->i", side, normal) / np.where(length > 0, length, 1)
        passes &= inward > OFF * size
    return int(passes.sum())


def asked_by(preset, skin):
    """Which pairs of faces the <contact>s of a preset ask for."""
    words = {}
    for n, body in enumerate(xml.parse(preset).getroot().findall("body")):
        contact = body.find("contact")
        words[n] = set() if contact is None else set(contact.get("with", "").split())
    count = max(len(skin.names), len(words))
    table = [[words.get(n, {"obstacles"}), n >= len(words)] for n in range(count)]
    fragments = np.array(["fragments" in one for one, _ in table])
    own = np.array(["self" in one for one, _ in table])
    obstacles = np.array(["obstacles" in one for one, _ in table])
    fixed = np.array([is_obstacle for _, is_obstacle in table])

    def asked(body, fragment, other, other_fragment):
        same = (body == other) & (fragment == other_fragment)
        with_obstacle = (fixed[body] ^ fixed[other]) & obstacles[body] & obstacles[other]
        between = ~fixed[body] & ~fixed[other] & fragments[body] & fragments[other]
        return np.where(same, own[body] & ~fixed[body], with_obstacle | between)

    return asked


def count_in(rend, preset, arguments):
    """The crossings in each frame."""
    with tempfile.TemporaryDirectory() as folder:
        sets = [word for one in arguments.set for word in ("--set", one)]
        steps = ["--steps", str(arguments.steps)] if arguments.steps else []
        done = subprocess.run([rend, "run", preset, "--export", "ply", "-o", folder, "-q", *sets, *steps],
                              capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{preset}: rend ended with {done.returncode}: {done.stderr}")
        counts = []
        for path in sorted(Path(folder).glob("*.ply")):
            skin = read_ply(path)
            counts.append(crossings(skin, asked_by(preset, skin)))
        return counts


def self_test():
    """Known surfaces, turned at random: what is counted, and what is not."""
    rnd = np.random.default_rng(5)
    flat = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]

    def count(second, shared=(), same_fragment=False, asked=None):
        turn = np.linalg.qr(rnd.normal(size=(3, 3)))[0]
        points = np.array(flat + list(second)) @ turn + rnd.normal(size=3)
        faces = [[0, 1, 2], [shared[n] if n < len(shared) else 3 + n for n in range(3)]]
        return crossings(Skin(points, faces, [0, 1], [0, 0 if same_fragment else 1]), asked)

    for _ in range(200):
        assert count([(0.2, 0.2, -1), (0.2, 0.2, 1), (3, 3, 1)]) == 2  # each has an edge through the other
        assert count([(0.2, 0.2, -1), (0.3, 0.2, 1), (0.2, 0.3, 1)]) == 2  # a tip through
        assert count([(0.2, 0.2, 0.1), (0.2, 0.2, 1), (3, 3, 1)]) == 0  # above
        assert count([(0.2, 0.2, 0), (0.2, 0.2, 1), (3, 3, 1)]) == 0  # touches it
        assert count([(2, 2, -1), (2, 2, 1), (3, 3, 1)]) == 0  # beside
        assert count([(0, 0, 0), (1, 0, 0), (0.2, -1, 0)]) == 0  # two torn sides lie on each other
        assert count([(0, 0, 0), (0.5, 0.5, -1), (-1, -1, 1)], shared=[0]) == 0  # at a vertex of both
        assert count([(0, 0, 0), (0.2, 0.2, -1), (0.2, 0.2, 1)], shared=[0]) == 1  # an edge of its own
        assert count([(0.2, 0.2, -1), (0.2, 0.2, 1), (3, 3, 1)], asked=lambda b, f, c, g: b == c) == 0
    # Two grids of n x n cells that cross along a line: each of n + 1 rows of edges passes through the other.
    for n in (4, 30):
        x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
        flat_grid = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
        upright = np.stack([np.full(x.size, 0.5003), 0.0001 + 0.9998 * x.ravel(), y.ravel() - 0.5137], axis=1)
        first = [j * (n + 1) + i for j in range(n) for i in range(n)]
        cells = [(at, at + 1, at + n + 1) for at in first] + [(at + 1, at + n + 2, at + n + 1) for at in first]
        faces = np.array(cells + [tuple(x.size + k for k in one) for one in cells])
        half = len(cells)
        body = [0] * half + [1] * half
        found = crossings(Skin(np.concatenate([flat_grid, upright]), faces, body, body))
        assert 2 * (n + 1) <= found <= 6 * (n + 1), found
    print("what crosses is counted, and nothing else")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rend", nargs="?")
    parser.add_argument("presets", nargs="*")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    parser.add_argument("--steps", type=int)
    parser.add_argument("--expect", type=int)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_intermixed_args()
    if arguments.self_test:
        self_test()
    elif not arguments.presets:
        parser.error("no preset")
    total = 0
    for preset in arguments.presets:
        counts = count_in(arguments.rend, preset, arguments)
        crossed = sum(n > 0 for n in counts)
        print(f"{Path(preset).stem:<24} {len(counts):>4} frames, {crossed:>4} with crossings, "
              f"{sum(counts):>6} in all, {max(counts):>5} at most", flush=True)
        total += sum(counts)
    if arguments.expect is not None and total > arguments.expect:
        sys.exit(1)


main()
