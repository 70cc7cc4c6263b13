#!/usr/bin/env python3
"""rules_as_laws.py REND: every built-in rule as the law of a body, on every mesh and material.

Each body is strained evenly, u = G X, and its law changes all places at the first step. A line for each
rule and mesh: exit code, changes, mass after / before; for each material the elastic energy and the largest
component of the mean stress, after / before; and why it was refused. Evenly strained elements keep both,
whatever they are divided into; springs do not. Rules that no law may have (of a component, with two hooks)
are left out.
"""
import json, os, re, subprocess, sys, tempfile

MESHES = [("sheet", p) for p in ("quads", "triangles", "mixed")] + \
         [("bar", p) for p in ("hexahedra", "tetrahedra", "prisms", "mixed")]
MODELS = {"springs": None, "linear": 'model="linear"', "corotational": 'model="corotational"',
          "mass-tensor": 'model="mass-tensor"', "enhanced": 'model="corotational" formulation="enhanced"'}


def preset(shape, pattern, model, tear):
    sheet = shape == "sheet"
    body = '<sheet pattern="%s" cells="4 4" size="1 1"/><mass density="100" thickness="0.01"/>' if sheet else \
           '<bar pattern="%s" cells="2 2 2" size="1 1 1"/><mass density="100"/>'
    if model is None:
        matter = '<springs><stretch k="60"/><shear kind="isotropic" k="40"/></springs>'
        criterion = 'criterion="strain" kind="stretch"'
    else:
        matter = '<elasticity %s young="2e5" poisson="0.3"%s/>' % (model, ' thickness="0.01"' if sheet else "")
        criterion = 'criterion="strain"'
    law = '<tear %s threshold="1e-6" until="1e-7" rule="%s"/>' % (criterion, tear) if tear else ""
    held = '<fix all="yes" axes="z"/>' if sheet else ""
    drive = '<drive all="yes" axes="%s" gradient="1e-3 5e-4 0 5e-4 2e-3 0 0 0 0"/>' % ("xy" if sheet else "xyz")
    return '<scene name="law"><body name="b">%s%s%s%s%s<probe name="p" all="yes"/></body>' \
           '<world gravity="0 0 0"/><time step="1e-6" integrator="symplectic" duration="3e-6"/></scene>' % \
           (body % pattern, matter, held, drive, law)


def run(rend, folder, text):
    path = os.path.join(folder, "law.xml")
    with open(path, "w") as file:
        file.write(text)
    done = subprocess.run([rend, "run", path, "--json", "-q", "--threads", "1"], capture_output=True, text=True)
    figures = json.loads(done.stdout) if done.stdout.startswith("{") else None
    return done.returncode, figures, done.stderr


def stress(figures):
    probe = figures["probes"]["p"]
    return max(probe["stress"].values()) if probe and probe.get("stress") else None


def ratio(after, before):
    if not before:
        return "-"
    return "%.4g" % (after / before) if after is not None else "none"


def unique(all):
    return " ".join(dict.fromkeys(str(each) for each in all))


def main():
    rend = sys.argv[1] if len(sys.argv) > 1 else "build/release/rend"
    listed = subprocess.run([rend, "rule", "list"], capture_output=True, text=True, check=True).stdout
    rules = [line.split()[0] for line in listed.splitlines() if re.match(r"[a-z][a-z-]+  *[-<]", line)]
    print("| rule | mesh | exit | changes | mass | " + " | ".join(MODELS) + " | refused |")
    print("|---|---|---|---|---|" + "---|" * len(MODELS) + "---|")
    with tempfile.TemporaryDirectory() as folder:
        before = {(mesh, name): run(rend, folder, preset(*mesh, model, None))[1]
                  for mesh in MESHES for name, model in MODELS.items()}
        for rule in rules:
            for mesh in MESHES:
                codes, tears, mass, cells, reasons = [], [], [], [], []
                for name, model in MODELS.items():
                    code, now, error = run(rend, folder, preset(*mesh, model, rule))
                    if code == 65 and "rule '%s'" % rule in error or "script '%s'" % rule in error:
                        break
                    codes.append(code)
                    if now is None:
                        cells.append("-")
                        continue
                    was = before[mesh, name]
                    tears.append(now["tears"])
                    mass.append(ratio(now["mass"], was["mass"]))
                    cells.append(ratio(now["energy"]["elastic"], was["energy"]["elastic"]) +
                                 (", " + ratio(stress(now), stress(was)) if stress(was) else ""))
                    reasons += list(now["laws"][0].get("refused", {})) if now.get("laws") else []
                if not codes:
                    continue
                name = "mixed solid" if mesh == ("bar", "mixed") else mesh[1]
                print("| %s |" % " | ".join([rule, name, unique(codes), unique(tears), unique(mass), *cells,
                                             "; ".join(dict.fromkeys(reasons))]), flush=True)


if __name__ == "__main__":
    main()
