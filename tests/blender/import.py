#!/usr/bin/python3
"""Tests presets/blender/import.py in Blender itself (3.4 or later, without a display).

    import.py REND [DIR]     DIR: where to keep the pictures

Two presets: a sheet that a falling sphere tears, and a solid that a turning box hits. Of each, the saved
Blender file is opened anew: in each frame the meshes that are shown have the points and faces that `--export
obj` has there, and what is solid has faces that fracture has laid bare. Then Blender renders a frame, and the
silhouette is compared with rend's own picture of it: camera, bodies and obstacles are where rend has them.
Prints errors and exits 1.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]

CLOTH = """<scene name="cloth">
  <body name="cloth"><sheet pattern="crossed" cells="16 16" size="1 1"/><place translate="-0.5 -0.5 0.7"/>
    <mass total="0.3"/><springs><stretch k="400" damping="0.05"/></springs><viscosity value="0.1" per="body"/>
    <fix side="-x"/><fix side="+x"/><tear criterion="atomic-border" threshold="5"/>
    <contact with="obstacles" thickness="0.01"/><look colour="#2a7f8e" back="#e7e0d2"/></body>
  <world><sphere centre="0.03 0.02 1" radius="0.15" mass="3" velocity="0 0 -3" colour="#3c4350"/></world>
  <time duration="0.4"/><camera eye="1.3 -1.8 1.5" target="0 0 0.5" fov="33" turn="30"/>
  <image size="320 180" fps="20" samples="16" background="none"/>
</scene>"""

BAR = """<scene name="bar">
  <body name="bar"><bar pattern="tetrahedra" cells="8 2 2" size="0.8 0.2 0.2"/><mass density="1000"/>
    <elasticity young="2e5" poisson="0.3" damping-stiffness="0.002"/><fix side="-x"/>
    <drive side="+x" velocity="0.5 0 0"/><tear criterion="vertex-stress" threshold="6e4"/>
    <look colour="#a04030" inside="#ffe0b0"/></body>
  <world gravity="0 0 0"><box low="0.3 0.3 -0.1" high="0.5 0.4 0.1">
    <key at="0.4" position="0.4 0.35 0.1" rotate="0 30 90"/></box></world>
  <time duration="0.5"/><camera eye="1.2 -1.4 0.9" target="0.45 0.1 0.1" fov="35"/>
  <image size="320 180" fps="10" samples="16" background="none"/>
</scene>"""

# Run in Blender, with the saved file: points and faces of what each frame shows, by body, and the bare faces.
LOOK = """
import bpy, json, sys
out = {}
for frame in range(bpy.context.scene.frame_start, bpy.context.scene.frame_end + 1):
    bpy.context.scene.frame_set(frame)
    shown = [t for t in bpy.data.objects if t.type == "MESH" and not t.hide_render and t.name[-5:].isdigit()]
    out[frame] = [{"name": t.name, "points": len(t.data.vertices), "faces": len(t.data.polygons),
                   "bare": sum(p.material_index == 1 for p in t.data.polygons)} for t in shown]
open(sys.argv[-1], "w").write(json.dumps(out))
"""

failed = False


def check(what, holds):
    global failed
    print(("ok  " if holds else "BAD ") + what)
    failed = failed or not holds


def blender(*arguments):
    done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1",
                           *map(str, arguments)], capture_output=True, text=True)
    check(f"blender {' '.join(str(a) for a in arguments if str(a).startswith('--'))} ends with 0",
          done.returncode == 0)
    if done.returncode:
        print(done.stdout[-2000:], done.stderr[-2000:])


def counts_of_obj(path):
    """By object: points and faces."""
    counts = {}
    for line in path.read_text().splitlines():
        word, *rest = line.split(maxsplit=1)
        if word == "o":
            counts[rest[0]] = name = [0, 0]
        elif word in "vf":
            name["vf".index(word)] += 1
    return counts


def silhouette(path):
    return numpy.asarray(Image.open(path).convert("RGBA"))[:, :, 3] > 127


def try_preset(rend, folder, keep, name, text, frame):
    preset = folder / f"{name}.xml"
    preset.write_text(text)
    run = lambda *words: subprocess.run([rend, *map(str, words), "-q"], check=True, capture_output=True)
    for format in ("ply", "obj"):
        run("run", preset, "--export", format, "-o", folder / format)
    run("render", preset, "--frames", frame, "-o", folder / "png")
    scene = folder / f"ply/{name}.scene.json"
    saved, picture = folder / f"{name}.blend", keep / f"{name}.png"
    blender("--python", ROOT / "presets/blender/import.py", "--", scene, "--save", saved, "--render", picture,
            "--frame", frame, "--samples", 16)
    blender(saved, "--python-expr", LOOK, "--", folder / "seen.json")
    seen = json.loads((folder / "seen.json").read_text())
    check(f"{name}: every frame is there", len(seen) == len(list((folder / "obj").glob("*.obj"))))
    shapes = set()
    for number, things in seen.items():
        expected = counts_of_obj(folder / f"obj/{int(number):05d}.obj")
        names = [t["name"] for t in things]
        check(f"{name}: frame {number} shows one mesh", names == [f"{name} {int(number):05d}"])
        check(f"{name}: frame {number} has {expected[name]} points and faces",
              [things[0]["points"], things[0]["faces"]] == expected[name])
        shapes.add((things[0]["points"], things[0]["faces"]))
    check(f"{name}: it tears, so that meshes differ: {len(shapes)}", len(shapes) > 1)
    bare = [things[0]["bare"] for things in seen.values()]
    check(f"{name}: faces laid bare, from frame to frame: {bare}",
          bare[0] == 0 and (bare[-1] > 0) == (name == "bar"))
    ours, theirs = silhouette(folder / f"png/{frame:05d}.png"), silhouette(picture)
    same = (ours & theirs).sum() / (ours | theirs).sum()
    check(f"{name}: silhouettes of frame {frame} agree: {100 * same:.1f} % of {(ours | theirs).sum()} pixels",
          same > 0.98 and ours.sum() > 3000)


with tempfile.TemporaryDirectory() as place:
    rend = Path(sys.argv[1]).resolve()
    keep = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(place)
    keep.mkdir(parents=True, exist_ok=True)
    for name, text, frame in (("cloth", CLOTH, 6), ("bar", BAR, 5)):
        folder = Path(place) / name
        folder.mkdir()
        try_preset(rend, folder, keep, name, text, frame)
sys.exit(failed)
