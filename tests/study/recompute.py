#!/usr/bin/python3
"""Recomputes some of rend's results independently from its output files, with numpy and scipy.

    recompute.py REND

1. Errors and an order. `rend study` of a cloth of springs writes errors into study.csv. The runs of one scheme
   and the reference are repeated with `rend run --export vtu`, and from the positions, velocities and masses
   in the .vtu files it computes the errors (mass-weighted root mean square, and over the samples), their scale,
   and the order (the slope of log error over log step).
2. A step limit. The stiffness of a bar of distorted hexahedra is assembled here, from the rest positions in a
   .vtu file and the preset's E and nu, by textbook trilinear elements with 2 x 2 x 2 Gauss points (Zienkiewicz
   & Taylor, The Finite Element Method, vol. 1); masses are those of the .vtu file. The highest frequency is an
   eigenvalue (Lanczos, ARPACK); symplectic Euler is stable up to 2/omega. It is compared with the step at which
   rend's runs become unstable, by bisection, and with the limit that `rend info` reports.

Prints both values of each quantity and the difference; exits 1 if a difference exceeds its tolerance.
"""
import base64
import csv
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

CLOTH = """<scene name="cloth"><body name="cloth">
  <sheet cells="8 8" size="1 1"/><place rotate="20 10 0"/><mass total="0.1"/>
  <springs><stretch k="60" damping="0.01"/><shear kind="isotropic" k="40"/><bend kind="provot" k="2"/></springs>
  <viscosity value="0.1" per="body"/><fix near="0 0 0"/><fix near="1 0 0"/></body>
  <world gravity="0 0 -9.81"/><time step="1e-3" integrator="verlet" duration="1"/></scene>"""

YOUNG, POISSON = 2e5, 0.3
BAR = f"""<scene name="bar"><body name="bar">
  <mesh file="bar.msh"/><mass density="1000"/>
  <elasticity model="linear" young="{YOUNG}" poisson="{POISSON}"/><fix side="-x"/></body>
  <world gravity="0.3 0.2 -9.81"/><time step="1e-4" integrator="symplectic" duration="1"/></scene>"""

TYPES = {"Float64": np.float64, "Int64": np.int64, "UInt8": np.uint8}


class State:
    """One .vtu file: every array by its name; x, rest and velocity as n x 3."""

    def __init__(self, path):
        text = Path(path).read_text()
        self.time = float(re.search(r'Name="TimeValue"[^>]*>([^<]*)<', text)[1])
        self.arrays = {}
        for kind, name, width, content in re.findall(
                r'<DataArray type="(\w+)" Name="([^"]+)"(?: NumberOfComponents="(\d+)")? '
                r'format="binary">([^<]*)<', text):
            raw = base64.b64decode(content)
            values = np.frombuffer(raw, TYPES[kind], offset=8)  # after the byte count
            assert values.nbytes == int(np.frombuffer(raw, np.uint64, 1)[0])
            self.arrays[name] = values.reshape(-1, int(width)) if width else values
        self.x, self.rest, self.velocity = (self.arrays[n] for n in ("Points", "rest", "velocity"))
        self.mass = self.arrays["mass"]


class Table:
    """The values that were computed twice."""

    def __init__(self):
        self.agrees = True
        print(f"{'what':<44}{'rend':>16}{'here':>16}{'difference':>12}{'allowed':>10}")

    def add(self, what, rend, here, allowed):
        difference = abs(rend - here) / abs(here)
        self.agrees = self.agrees and difference <= allowed
        print(f"{what:<44}{rend:>16.9g}{here:>16.9g}{difference:>12.1e}{allowed:>10.0e}"
              f"{'' if difference <= allowed else '  DISAGREES'}")


def call(rend, *words, codes=(0,)):
    done = subprocess.run([rend, *map(str, words)], capture_output=True, text=True)
    if done.returncode not in codes:
        sys.exit(f"rend {' '.join(map(str, words))} ended with {done.returncode}: {done.stderr}")
    return done


def trajectory(rend, preset, folder, scheme, step, steps, samples, duration):
    """The states at `samples` equidistant times after the start, and the initial one."""
    call(rend, "run", preset, "-q", "--export", "vtu", "-o", folder,
         "--set", f"time.integrator={scheme}", "--set", f"time.step={step!r}", "--steps", steps,
         "--fps", repr(samples / duration))
    names = re.findall(r'file="([^"]+)"', (folder / "cloth.pvd").read_text())
    states = [State(folder / name) for name in names]
    assert len(states) == samples + 1, f"{len(states)} states in {folder}"
    return states


def norm(mass, vectors):
    return math.sqrt((mass @ (vectors**2).sum(axis=1)) / mass.sum())


def errors_and_order(rend, folder, table):
    preset = folder / "cloth.xml"
    preset.write_text(CLOTH)
    call(rend, "study", preset, "-q", "--quick", "--steps", 4, "--reruns", 1, "--integrators", "verlet", "-o",
         folder / "study")
    report = json.loads((folder / "study/study.json").read_text())
    with open(folder / "study/study.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    duration, samples, reference = report["duration"], report["samples"], report["references"][0]
    steps = round(duration / reference["step"])
    truth = trajectory(rend, preset, folder / "reference", reference["scheme"], reference["step"], steps,
                       samples, duration)
    mass = truth[0].mass
    length = max(norm(mass, state.x - truth[0].x) for state in truth)
    table.add("scale of lengths [m]", reference["length"], length, 1e-9)

    curve = report["curves"][0]
    used = curve["fit"]["rows"]
    found = {}
    for n in used:
        row = rows[n]
        run = trajectory(rend, preset, folder / f"run-{n}", row["integrator"], float(row["step"]), row["steps"],
                         samples, duration)
        over_time = math.sqrt(np.mean([norm(mass, a.x - b.x) ** 2 for a, b in zip(run[1:], truth[1:])]))
        found[n] = over_time / length
        step = float(row["step"])
        table.add(f"error of position over time, h = {step:.3g}", float(row["error"]), found[n], 1e-6)
        table.add(f"error of velocity at the end [m/s], h = {step:.3g}", float(row["velocity_l2_final"]),
                  norm(mass, run[-1].velocity - truth[-1].velocity), 1e-6)
    slope = np.polyfit([math.log(float(rows[n]["step"])) for n in used],
                       [math.log(found[n]) for n in used], 1)[0]
    table.add("order of velocity Verlet", curve["fit"]["order"], slope, 1e-6)
    table.add("   and by theory", slope, curve["theory"], 0.05)


def distorted_bar(cells, size):
    """A Gmsh file (2.2, ASCII) of hexahedra with displaced inner points: no two are equal."""
    axes = [np.linspace(0, s, n + 1) for n, s in zip(cells, size)]
    points = np.array([(x, y, z) for z in axes[2] for y in axes[1] for x in axes[0]])
    inside = np.all((points > 0) & (points < size), axis=1)
    shift = np.random.default_rng(1).uniform(-0.2, 0.2, points.shape) * np.array(size) / cells
    points[inside] += shift[inside]
    nx, ny = cells[0] + 1, (cells[0] + 1) * (cells[1] + 1)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(points))]
    lines += [f"{n + 1} {x!r} {y!r} {z!r}" for n, (x, y, z) in enumerate(points.tolist())]
    first = [i + j * nx + k * ny + 1 for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])]
    ring = np.array([0, 1, nx + 1, nx, ny, ny + 1, ny + nx + 1, ny + nx])
    lines += ["$EndNodes", "$Elements", str(len(first))]
    lines += [f"{n + 1} 5 0 " + " ".join(map(str, f + ring)) for n, f in enumerate(first)]
    return "\n".join(lines + ["$EndElements", ""])


def stiffness_of_hexahedron(x):
    """24 x 24 stiffness for corners x (8 x 3) in VTK's order: sum of B^T C B det J over the Gauss points."""
    lame, shear = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
    c = np.diag([2 * shear] * 3 + [shear] * 3)
    c[:3, :3] += lame
    signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1),
                      (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])
    k = np.zeros((24, 24))
    for point in signs / math.sqrt(3):
        terms = 1 + signs * point
        local = np.stack([signs[:, a] * np.prod(np.delete(terms, a, axis=1), axis=1) / 8 for a in range(3)],
                         axis=1)
        jacobian = x.T @ local
        g = local @ np.linalg.inv(jacobian)
        b = np.zeros((6, 24))
        for n in range(8):
            gx, gy, gz = g[n]
            b[:, 3 * n:3 * n + 3] = [(gx, 0, 0), (0, gy, 0), (0, 0, gz), (gy, gx, 0), (0, gz, gy), (gz, 0, gx)]
        k += b.T @ c @ b * np.linalg.det(jacobian)
    return k


def highest_frequency(state):
    """The highest frequency [rad/s], with prescribed vertices fixed."""
    count = len(state.mass)
    cells = state.arrays["connectivity"].reshape(-1, 8)
    assert (state.arrays["types"] == 12).all()
    rows, columns, values = [], [], []
    for corners in cells:
        places = (3 * corners[:, None] + np.arange(3)).ravel()
        rows.append(np.repeat(places, 24))
        columns.append(np.tile(places, 24))
        values.append(stiffness_of_hexahedron(state.rest[corners]).ravel())
    k = scipy.sparse.coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                                shape=(3 * count, 3 * count)).tocsr()
    free = np.repeat(state.arrays["prescribed"] == 0, 3)
    weight = scipy.sparse.diags(1 / np.sqrt(np.repeat(state.mass, 3)[free]))
    scaled = weight @ k[free][:, free] @ weight
    return math.sqrt(scipy.sparse.linalg.eigsh(scaled, k=1, which="LA", return_eigenvectors=False)[0])


def step_limit(rend, folder, table):
    preset = folder / "bar.xml"
    preset.write_text(BAR)
    (folder / "bar.msh").write_text(distorted_bar((6, 3, 2), (0.6, 0.25, 0.2)))
    call(rend, "run", preset, "-q", "--export", "vtu", "-o", folder / "bar", "--steps", 0)
    limit = 2 / highest_frequency(State(folder / "bar/00000.vtu"))

    def stable(step):
        done = call(rend, "run", preset, "-q", "--json", "--no-guard", "--steps", 2000,
                    "--set", f"time.step={step!r}", codes=(0, 76))
        return done.returncode == 0 and json.loads(done.stdout)["energy"]["kinetic"] < 1e3

    low, high = 0.87 * limit, 1.11 * limit
    assert stable(low) and not stable(high), "the limit is not where it is looked for"
    while high - low > 1e-4 * limit:
        middle = (low + high) / 2
        low, high = (middle, high) if stable(middle) else (low, middle)
    table.add("step limit of symplectic, bisected [s]", (low + high) / 2, limit, 2e-3)
    info = json.loads(call(rend, "info", preset, "--json").stdout)["time"]
    vouched = info["limit"]
    print(f"{'   what rend info vouches for':<44}{vouched:>16.9g}{limit:>16.9g}   {vouched / limit:.3f} of it")
    if vouched > limit * (1 + 1e-3):
        sys.exit("rend info vouches for a step that is not stable")


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: recompute.py REND")
    table = Table()
    with tempfile.TemporaryDirectory() as folder:
        errors_and_order(sys.argv[1], Path(folder), table)
        step_limit(sys.argv[1], Path(folder), table)
    sys.exit(0 if table.agrees else 1)


main()
