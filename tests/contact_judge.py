#!/usr/bin/env python3
"""Random scenes with contact, judged from outside.

    tests/contact_judge.py REND [--scenes N] [--first SEED] [--large] [--keep FOLDER]

Bodies are dropped, thrown at each other, stacked, torn or pressed by an obstacle that moves, under every
explicit scheme and 1/8 to 1/2 of the stable step; with --large 1 to 4 times that, where K + U may swing by so
much that little is seen. Their kinetic and elastic energy K + U and their potential G are read from the frames
of --diagnostics; the program's own account of energy is not looked at.

  absurd    exit 0, and K + U is above the most that is possible: where nothing moves as prescribed, what
            K + U + G was at the start above the least G that was seen; elsewhere 1.5 times the most that
            velocity Verlet had at a quarter of its limit. Symplectic Euler and Verlet keep another number,
            which bounds K + U to 1/(1 - h/h_max) times that: they may swing by so much
  false 76  the run is refused at the stable step or below it, where Verlet at a quarter of its limit runs

Prints these and the counts; exits with 1 if there are any.
"""
import argparse
import csv
import json
import random
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

SCHEMES = ["symplectic", "symplectic", "verlet", "rk4", "rk45", "midpoint", "explicit"]
MOST_SECONDS = 300  # of computing, for a run: on a busy machine it may take longer


def limit_time():
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS + 10))


def shape(rnd):
    """A child of <body>, its matter, its height [m]."""
    size = [round(rnd.uniform(0.1, 0.5), 3) for _ in range(3)]
    mass = f'<mass total="{rnd.uniform(0.05, 5):.4g}"/>'
    drag = f'<viscosity value="{rnd.uniform(0.2, 2):.3g}" per="body"/>'
    if rnd.random() < 0.4:
        cells = rnd.randint(2, 8)
        pattern = rnd.choice(["quads", "triangles", "mixed"])
        stretch = 10 ** rnd.uniform(1, 3.5)
        return (f'<sheet pattern="{pattern}" cells="{cells} {cells}" size="{size[0]} {size[1]}"/>',
                mass + f'<springs><stretch k="{stretch:.4g}" damping="{rnd.choice([0, 0.02])}"/>'
                f'<bend kind="provot" k="{0.1 * stretch:.4g}"/></springs>' + drag, 0.0)
    cells = " ".join(str(rnd.randint(1, 4)) for _ in range(3))
    pattern = rnd.choice(["tetrahedra", "hexahedra"])
    damping = rnd.choice(["", f' damping-stiffness="{10 ** rnd.uniform(-5, -3):.3g}"'])
    return (f'<bar pattern="{pattern}" cells="{cells}" size="{size[0]} {size[1]} {size[2]}"/>',
            mass + f'<elasticity model="{rnd.choice(["corotational", "linear"])}" '
            f'young="{10 ** rnd.uniform(4, 6.5):.4g}" poisson="{rnd.choice([0, 0.3])}"{damping}/>' + drag,
            size[2])


def scene(seed):
    """Its XML, with {integrator} and {step}; whether something moves as prescribed."""
    rnd = random.Random(seed)
    bodies, top = "", 0.0
    thickness = rnd.choice([0.001, 0.002, 0.01])
    tears = rnd.random() < 0.3
    for n in range(rnd.randint(1, 3)):
        made, matter, height = shape(rnd)
        top += thickness + rnd.choice([0, 0, rnd.uniform(0, 0.3)])
        angles = f"{rnd.uniform(-60, 60):.3g} {rnd.uniform(-60, 60):.3g} 0"
        turn = "" if rnd.random() < 0.5 else f' rotate="{angles}"'
        if turn:
            top += 0.6
        velocity = "" if rnd.random() < 0.6 else ' velocity="{:.3g} {:.3g} {:.3g}"'.format(
            *(rnd.uniform(-2, 2) for _ in range(3)))
        law = ""
        if tears and "bar" in made:
            law = f'<tear criterion="vertex-stress" threshold="{10 ** rnd.uniform(3, 5):.3g}"/>'
        elif tears:
            law = f'<tear criterion="atomic-spring" kind="stretch" threshold="{10 ** rnd.uniform(-1, 1):.3g}"/>'
        bodies += (f'<body name="b{n}">{made}<place translate="0 0 {top:.4g}"{turn}{velocity}/>{matter}{law}'
                   f'<contact with="obstacles {rnd.choice(["fragments", "fragments", "self"])}" '
                   f'thickness="{thickness}" friction="{rnd.choice([0, 0.3, 0.8])}"/></body>')
        top += height + (0.6 if turn else 0)
    moved = rnd.random() < 0.3
    obstacles = '<floor z="0"/>'
    if moved:
        obstacles += (f'<box low="-1 -1 {top + 0.1:.4g}" high="1 1 {top + 0.3:.4g}">'
                      f'<key at="0.1" position="0 0 {top + 0.2:.4g}"/>'
                      f'<key at="0.6" position="0 0 {0.75 * top + 0.2:.4g}"/></box>')
    if rnd.random() < 0.4:
        obstacles += (f'<sphere centre="0.1 0.1 {top + 0.8:.4g}" radius="0.15" '
                      f'mass="{10 ** rnd.uniform(-1, 1.5):.3g}" velocity="0 0 {rnd.uniform(-5, 0):.3g}"/>')
    elif rnd.random() < 0.4:
        obstacles += '<sphere centre="0.1 0.1 0" radius="0.1"/>'
    xml = (f'<scene name="s{seed}">{bodies}<world>{obstacles}</world>'
           '<time integrator="{integrator}" step="{step}" duration="0.8"/><image fps="250"/></scene>')
    return xml, moved


class Judge:
    def __init__(self, rend, folder, large):
        self.rend, self.folder = rend, folder
        self.factors = [1, 1, 2, 4] if large else [0.125, 0.25, 0.25, 0.5]

    def run(self, name, xml):
        """Exit code, rows of the diagnostics, figures, message."""
        preset, table = self.folder / f"{name}.xml", self.folder / f"{name}.csv"
        preset.write_text(xml)
        table.unlink(missing_ok=True)
        done = subprocess.run([self.rend, "run", preset, "--json", "-q", "--threads", "1",
                               "--diagnostics", table],
                              capture_output=True, text=True, preexec_fn=limit_time)
        if done.returncode == 128 + signal.SIGXCPU:
            return None, [], {}, f"no end after {MOST_SECONDS} s"
        rows = []
        if table.exists():
            rows = [{k: float(row[k]) for k in ("kinetic", "elastic", "gravity")}
                    for row in csv.DictReader(table.open())]
        return done.returncode, rows, json.loads(done.stdout) if done.stdout else {}, done.stderr.strip()

    def limit(self, name, xml):
        """The automatic step of Verlet [s], 0.9 of its limit; none: the scene is refused."""
        preset = self.folder / f"{name}.xml"
        preset.write_text(xml.format(integrator="verlet", step="auto"))
        done = subprocess.run([self.rend, "info", preset, "--json"], capture_output=True, text=True)
        return json.loads(done.stdout)["time"]["step"] if done.returncode == 0 else None

    def judge(self, seed):
        """'', or what is wrong."""
        xml, moved = scene(seed)
        stable = self.limit(f"{seed}-limit", xml)
        if stable is None:
            return "refused"
        rnd = random.Random(-seed)
        scheme, factor = rnd.choice(SCHEMES), rnd.choice(self.factors)
        code, rows, _, said = self.run(seed, xml.format(integrator=scheme, step=factor * stable))
        if code == 0:
            swing = 1 / (1 - 0.9 * min(factor, 1))
            return self.absurd(seed, xml, moved, stable, rows, swing, f"{scheme} at {factor}")
        if code is None:
            return f"{scheme} at {factor}: {said}"
        if code == 76 and factor <= 1 and scheme in ("symplectic", "verlet", "rk4", "rk45"):
            if self.run(f"{seed}-reference", xml.format(integrator="verlet", step=0.25 * stable))[0] == 0:
                return f"false 76: {scheme} at {factor}: {said}"
        return "" if code in (76, 65) else f"exit {code}: {said}"

    def absurd(self, seed, xml, moved, stable, rows, swing, what):
        highest = max(row["kinetic"] + row["elastic"] for row in rows)
        if moved:
            reference = self.run(f"{seed}-reference", xml.format(integrator="verlet", step=0.25 * stable))
            if reference[0] != 0:
                return ""
            possible = 1.5 * max(row["kinetic"] + row["elastic"] for row in reference[1])
        else:
            first = rows[0]
            possible = sum(first.values()) - min(row["gravity"] for row in rows)
        if highest > 1.02 * swing * possible + 1e-9:
            return f"absurd: {what}: K + U = {highest:.4g} J where {swing * possible:.4g} J are possible"
        return ""


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("rend")
    arguments.add_argument("--scenes", type=int, default=60)
    arguments.add_argument("--first", type=int, default=1)
    arguments.add_argument("--large", action="store_true")
    arguments.add_argument("--keep", type=Path)
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.keep or Path(temporary)
        folder.mkdir(exist_ok=True)
        judge = Judge(Path(given.rend).resolve(), folder, given.large)
        wrong, refused = 0, 0
        for seed in range(given.first, given.first + given.scenes):
            said = judge.judge(seed)
            refused += said == "refused"
            if said and said != "refused":
                wrong += 1
                print(f"scene {seed}: {said}", flush=True)
    print(f"{given.scenes} scenes, {refused} refused, {wrong} wrong")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
