#!/usr/bin/python3
"""Compares pictures on bodies with ones that numpy computes from the documents alone.

    texture_reference.py REND [--keep FOLDER] [--only SCENE]

Scenes of 128 x 128 pixels, one sample in the middle of each pixel: a sheet seen at a low angle, the same with
a picture that is repeated and turned, a box, and a sheet with a JPEG that a camera stored on its side, turned
by 30 degrees. Here, for each pixel: the ray through it, the point of the body that it hits, the place in the
picture (presets/README.md, render/picture/texture_map.h), the level by the longer one of its two derivatives on
the screen (OpenGL 3.3, 3.8.11), eight texels in linear light (IEC 61966-2-1), and levels that are means over
areas. The JPEG is decoded, and set upright, by Pillow.

What the lamps do to a colour c is a c + b, where a and b differ from pixel to pixel, and colours are squares of
numbers (shaders/common.glsl): both are measured on the same body in black and in grey, without a picture.

Prints the mean FLIP of `rend diff` inside the body, 2 pixels away from every edge, against the expected picture
and against that picture upside down. Exits 1 if one of the first is above 0.05, or one of the second below
0.10.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageOps
from scipy import ndimage

SIDE = 128           # [pixels]
ALLOWED, FAR = 0.05, 0.10
GREY = 128


def light_of(number):
    return np.where(number > 0.04045, ((number + 0.055) / 1.055)**2.4, number / 12.92)


def number_of(light):
    return np.where(light > 0.0031308, 1.055 * np.maximum(light, 0)**(1 / 2.4) - 0.055, 12.92 * light)


def drawing(width, height):
    """Colours that change slowly, rings, a grid, and a letter F, so that no turn of it looks like another."""
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    out = np.stack([60 + 120 * x, 150 - 90 * y, 80 + 60 * np.sin(7 * x + 4 * y)], axis=-1)
    ring = np.hypot(x - 0.3, (y - 0.65) * height / width)
    out[(ring * 18 % 1 < 0.4) & (ring < 0.25)] = (200, 170, 40)
    out[(x * 12 % 1 < 0.08) | (y * 9 % 1 < 0.08)] = (20, 30, 40)
    bar = lambda left, right, top, bottom: (x > left) & (x < right) & (y > top) & (y < bottom)
    letter = bar(0.57, 0.63, 0.15, 0.75) | bar(0.6, 0.85, 0.14, 0.22) | bar(0.6, 0.78, 0.36, 0.44)
    out[letter] = (220, 60, 50)
    return np.clip(out, 0, 255).astype(np.uint8)


class Face:
    """A rectangle: its middle, and the directions in which a picture on it goes to the right and up."""

    def __init__(self, middle, right, up, half):
        self.middle, self.right, self.up = (np.array(v, dtype=float) for v in (middle, right, up))
        self.half = half  # of its extent to the right and up [m]
        self.normal = np.cross(self.right, self.up)

    def hit(self, eye, rays):
        """Distances along the rays, and places on the plane, to the right and up of its middle [m]."""
        along = ((self.middle - eye) @ self.normal) / (rays @ self.normal)
        at = eye + along[..., None] * rays - self.middle
        return along, np.stack([at @ self.right, at @ self.up], axis=-1)


def sheet_faces():
    return [Face((0.5, 0.5, 0), (1, 0, 0), (0, 1, 0), (0.5, 0.5))]


def box_faces(size):
    """Upright as seen from outside: z is up, on faces across z it is y."""
    faces = []
    for axis in range(3):
        for side in (1, -1):
            normal, up = np.zeros(3), np.zeros(3)
            normal[axis] = side
            up[1 if axis == 2 else 2] = 1
            right = np.cross(up, normal)
            half = [abs(v) @ size / 2 for v in (right, up)]
            faces.append(Face(size / 2 + normal * size / 2, right, up, half))
    return faces


class Camera:
    def __init__(self, eye, target, fov):
        in_words = lambda v: " ".join(str(x) for x in v)
        self.text = f'<camera eye="{in_words(eye)}" target="{in_words(target)}" fov="{fov}"/>'
        self.eye = np.array(eye, dtype=float)
        ahead = np.array(target) - self.eye
        self.ahead = ahead / np.linalg.norm(ahead)
        right = np.cross(self.ahead, (0, 0, 1))
        self.right = right / np.linalg.norm(right)
        self.up = np.cross(self.right, self.ahead)
        self.tangent = math.tan(math.radians(fov) / 2)

    def rays(self, dx=0.0, dy=0.0):
        """Through the middles of all pixels, moved by so much to the right and down."""
        at = (2 * (np.arange(SIDE) + 0.5) / SIDE - 1) * self.tangent
        step = 2 / SIDE * self.tangent
        x, y = np.meshgrid(at + dx * step, -(at + dy * step))
        return self.ahead + x[..., None] * self.right + y[..., None] * self.up


def halving(n):
    """m x n: the means over m equal parts of n texels, m = n / 2 rounded down."""
    m = max(n // 2, 1)
    ends = np.arange(m + 1) * n / m
    overlap = np.minimum.outer(ends[1:], np.arange(n) + 1.0) - np.maximum.outer(ends[:-1], np.arange(n))
    return np.maximum(overlap, 0) * m / n


def levels_of(picture):
    levels = [light_of(picture[::-1] / 255)]  # row 0 at the bottom
    while max(levels[-1].shape[:2]) > 1:
        height, width = levels[-1].shape[:2]
        rows = np.tensordot(halving(height), levels[-1], axes=1)
        levels.append(np.einsum("lk,ikc->ilc", halving(width), rows))
    return levels


def bilinear(level, uv, repeat):
    height, width = level.shape[:2]
    x, y = uv[..., 0] * width - 0.5, uv[..., 1] * height - 0.5
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    s, t = (x - i)[..., None], (y - j)[..., None]
    if repeat:
        texel = lambda a, b: level[b % height, a % width]
    else:
        texel = lambda a, b: level[np.clip(b, 0, height - 1), np.clip(a, 0, width - 1)]
    return (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) + \
        t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1))


def sampled(levels, uv, steps, repeat):
    """steps: the derivatives of uv to the right and down."""
    size = np.array(levels[0].shape[1::-1])
    rho = np.maximum(*(np.linalg.norm(step * size, axis=-1) for step in steps))
    which = np.clip(np.log2(rho), 0, len(levels) - 1)
    low = np.floor(which).astype(int)
    out = np.zeros(uv.shape[:2] + (3,))
    for n, level in enumerate(levels):
        share = np.where(low == n, 1 - (which - low), np.where(low + 1 == n, which - low, 0))
        out += share[..., None] * bilinear(level, uv, repeat)
    return out


class Scene:
    def __init__(self, name, shape, faces, camera, picture, size, scale=(1, 1), turn=0, repeat=False,
                 photograph=False):
        self.name, self.shape, self.faces, self.camera = name, shape, faces, camera
        self.picture = picture
        self.size = np.array(size) * scale  # on the body, to the right and up [m]
        self.turn, self.repeat = math.radians(turn), repeat
        self.file = "picture.jpg" if photograph else "picture.png"
        self.look = f'texture="{self.file}" scale="{scale[0]} {scale[1]}" rotate="{turn}" ' \
                    f'wrap="{"repeat" if repeat else "clamp"}"'

    def save(self, folder):
        """The picture is then what the file shows."""
        if self.file == "picture.png":
            Image.fromarray(self.picture).save(folder / self.file)
            return
        exif = Image.Exif()
        exif[0x0112] = 6  # the first row is seen at the right, the first column at the top
        stored = Image.fromarray(self.picture).transpose(Image.Transpose.ROTATE_90)
        stored.save(folder / self.file, quality=95, exif=exif)
        self.picture = np.asarray(ImageOps.exif_transpose(Image.open(folder / self.file)).convert("RGB"))

    def place(self, at):
        """In the picture, from places on a face: (0, 0) is its bottom left corner, (1, 1) the top right one."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        turned = np.stack([c * at[..., 0] + s * at[..., 1], c * at[..., 1] - s * at[..., 0]], axis=-1)
        return turned / self.size + 0.5

    def expected(self, upside_down=False):
        """Linear light of the picture at each pixel; where it is compared."""
        light, mask = np.zeros((SIDE, SIDE, 3)), np.zeros((SIDE, SIDE), dtype=bool)
        levels = levels_of(self.picture[::-1] if upside_down else self.picture)
        eye, rays = self.camera.eye, self.camera.rays()
        for face in self.faces:
            if (eye - face.middle) @ face.normal <= 0:
                continue
            along, at = face.hit(eye, rays)
            inside = (along > 0) & (abs(at) <= face.half).all(axis=-1)
            places = [[self.place(face.hit(eye, self.camera.rays(*(sign * v for v in step)))[1])
                       for sign in (0.5, -0.5)] for step in ((1, 0), (0, 1))]
            uv = self.place(np.where(inside[..., None], at, 0))
            steps = [np.where(inside[..., None], a - b, 1) for a, b in places]
            light[inside] = sampled(levels, uv, steps, self.repeat)[inside]
            mask |= ndimage.binary_erosion(inside, np.ones((3, 3)), iterations=2)
        return light, mask

    def preset(self, look):
        return f"""<scene name="{self.name}">
<body>{self.shape}<mass total="0.1"/><springs><stretch k="9"/></springs>
<look finish="matte" edges="no" {look}/></body><world gravity="0 0 0"/>{self.camera.text}
<time step="1e-3" duration="0.1"/><image size="{SIDE} {SIDE}" fps="10" samples="1"/></scene>"""


def scenes():
    sheet = '<sheet cells="4 4" size="1 1"/>'
    low = Camera((0.42, -0.55, 0.42), (0.5, 0.36, 0), 42)
    yield Scene("oblique", sheet, sheet_faces(), low, drawing(512, 512), (1, 1))
    wide = drawing(300, 200)
    yield Scene("repeated", sheet, sheet_faces(), low, wide, (1, 1), scale=(0.4, 0.3), turn=20, repeat=True)
    above = Camera((2, -1.5, 1.6), (0.5, 0.35, 0.2), 30)
    yield Scene("box", '<bar cells="1 1 1" size="1 0.7 0.5"/>', box_faces(np.array([1, 0.7, 0.5])), above, wide,
                (1, 200 / 300), repeat=True)
    over = Camera((0.6, -0.1, 1.4), (0.5, 0.48, 0), 40)
    yield Scene("photograph", sheet, sheet_faces(), over, drawing(480, 360), (1, 1), turn=30, repeat=True,
                photograph=True)


def rendered(rend, folder, name, preset):
    file = folder / f"{name}.xml"
    file.write_text(preset, encoding="utf-8")
    subprocess.run([rend, "render", file, "-q", "--frames", "0", "-o", folder / name], check=True)
    return np.asarray(Image.open(folder / name / "00000.png").convert("RGB"))


def flip(rend, folder, expected, now, mask):
    files = [folder / f"{name}.png" for name in ("expected", "now", "mask")]
    for file, levels in zip(files, (expected, now, mask)):
        Image.fromarray(levels).save(file)
    done = subprocess.run([rend, "diff", *files[:2], "--mask", files[2], "--json"],
                          capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(f"rend diff ended with {done.returncode}: {done.stderr}")
    case = json.loads(done.stdout)["cases"][0]
    if "figures" not in case and done.returncode != 0:
        sys.exit(f"rend diff compared nothing: {done.stdout}{done.stderr}")
    return case["figures"]["flip"]["mean"] if "figures" in case else 0.0  # the same bytes


def compare(rend, folder, scene):
    """Mean FLIP from the expected picture, and from the one upside down."""
    folder.mkdir()
    scene.save(folder)
    now = rendered(rend, folder, "now", scene.preset(scene.look))
    lit = [rendered(rend, folder, name, scene.preset(f'colour="#{level:02x}{level:02x}{level:02x}"')) / 255
           for name, level in (("black", 0), ("grey", GREY))]
    added = lit[0]**2
    factor = (lit[1]**2 - added) / (GREY / 255)**2
    figures = []
    for upside_down in (False, True):
        light, mask = scene.expected(upside_down)
        if mask.sum() < 2000:
            sys.exit(f"{scene.name}: only {mask.sum()} pixels are compared")
        numbers = np.sqrt(np.minimum(number_of(light)**2 * factor + added, 1))
        expected = np.where(mask[..., None], np.rint(255 * numbers).astype(np.uint8), now)
        place = folder / ("upside-down" if upside_down else "upright")
        place.mkdir()
        figures.append(flip(rend, place, expected, now, mask.astype(np.uint8) * 255))
    return figures + [int(mask.sum())]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rend")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="leave all pictures there")
    parser.add_argument("--only", metavar="SCENE")
    arguments = parser.parse_args()
    if arguments.only and arguments.only not in [scene.name for scene in scenes()]:
        sys.exit(f"there is no scene {arguments.only}")
    holds = True
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        print(f"{'scene':<12}{'pixels':>8}{'FLIP':>10}{'upside down':>14}")
        for scene in scenes():
            if arguments.only and scene.name != arguments.only:
                continue
            near, far, pixels = compare(arguments.rend, folder / scene.name, scene)
            good = near <= ALLOWED and far >= FAR
            holds = holds and good
            print(f"{scene.name:<12}{pixels:>8}{near:>10.4f}{far:>14.4f}{'' if good else '  WRONG'}")
    sys.exit(0 if holds else 1)


main()
