#!/usr/bin/python3
"""Recomputes the metrics of `rend diff` independently, with numpy, scipy and scikit-image.

    recompute.py REND

SSIM, RMSE and PSNR are scikit-image's (structural_similarity with its defaults). FLIP is
implemented here from the paper (Andersson et al. 2020), with two-dimensional filters in double precision; this
implementation is first checked against values of the authors' program for uniform pictures. Pictures: noise, a
gradient with a patch, a drawing; grey, palette, 16 bits, with alpha (on white).

Prints both values of each metric and the difference; exits 1 if a difference exceeds its tolerance.
"""
import json
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import numpy as np
from PIL import Image
from scipy import ndimage
from skimage import metrics

PPD = 67.0206
TO_XYZ = np.array([[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
                   [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
                   [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]])
WHITE = np.array([0.950428545, 1.0, 1.088900371])


def linear(srgb):
    return np.where(srgb > 0.04045, ((srgb + 0.055) / 1.055)**2.4, srgb / 12.92)


def ycxcz(rgb):
    x, y, z = np.moveaxis(rgb @ TO_XYZ.T / WHITE, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def rgb_of_ycxcz(c):
    y = (c[..., 0] + 16) / 116
    xyz = np.stack([y + c[..., 1] / 500, y, y - c[..., 2] / 200], axis=-1) * WHITE
    return np.clip(xyz @ np.linalg.inv(TO_XYZ).T, 0, 1)


def hunt_lab(rgb):
    t = rgb @ TO_XYZ.T / WHITE
    f = np.where(t > (6 / 29)**3, np.cbrt(t), t / (3 * (6 / 29)**2) + 4 / 29)
    light = 116 * f[..., 1] - 16
    return np.stack([light, 0.01 * light * 500 * (f[..., 0] - f[..., 1]),
                     0.01 * light * 200 * (f[..., 1] - f[..., 2])], -1)


def hyab(a, b):
    return np.abs(a[..., 0] - b[..., 0]) + np.hypot(a[..., 1] - b[..., 1], a[..., 2] - b[..., 2])


def grid(radius):
    y, x = np.mgrid[-radius:radius + 1, -radius:radius + 1]
    return x, y


def blurred(c):
    x, y = grid(int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * PPD)))
    out = []
    for n, terms in enumerate([[(1, 0.0047)], [(1, 0.0053)], [(34.1, 0.04), (13.5, 0.025)]]):
        g = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * (x**2 + y**2) / PPD**2 / b) for a, b in terms)
        out.append(ndimage.correlate(c[..., n], g / g.sum(), mode="nearest"))
    return np.stack(out, axis=-1)


def features(luma, point):
    deviation = 0.5 * 0.082 * PPD
    x, y = grid(int(np.ceil(3 * deviation)))
    g = np.exp(-(x**2 + y**2) / (2 * deviation**2)) * (x**2 / deviation**2 - 1 if point else -x)
    g = np.where(g < 0, g / -g[g < 0].sum(), g / g[g > 0].sum())
    return np.hypot(*(ndimage.correlate(luma, k, mode="nearest") for k in (g, g.T)))


def flip(a, b):
    a, b = ycxcz(linear(a / 255)), ycxcz(linear(b / 255))
    corner = lambda *rgb: hunt_lab(np.array(rgb, dtype=float))
    most = hyab(corner(0, 1, 0), corner(0, 0, 1))**0.7
    e = hyab(*(hunt_lab(rgb_of_ycxcz(blurred(c))) for c in (a, b)))**0.7
    colour = np.where(e < 0.4 * most, e * 0.95 / (0.4 * most), 0.95 + (e - 0.4 * most) / (0.6 * most) * 0.05)
    apart = [np.abs(features((a[..., 0] + 16) / 116, p) - features((b[..., 0] + 16) / 116, p))
             for p in (False, True)]
    return colour**(1 - np.clip(np.sqrt(np.maximum(*apart) / np.sqrt(2)), 0, 1))


def weighted_percentile(values, percent):
    values = np.sort(values.ravel())
    sums = np.cumsum(values)
    return values[np.searchsorted(sums, sums[-1] * percent / 100)]


def check_flip():
    flat = lambda *rgb: np.full((20, 20, 3), rgb, dtype=float)
    for a, b, known in [((0, 255, 0), (0, 0, 255), 1), ((0, 0, 0), (255, 255, 255), 0.967380),
                        ((128, 128, 128), (129, 129, 129), 0.029855),
                        ((128, 128, 128), (136, 136, 136), 0.127561)]:
        assert abs(flip(flat(*a), flat(*b)).mean() - known) < 2e-6, known
    dot = np.zeros((64, 64, 3))
    dot[32, 32] = 255
    map_ = flip(np.zeros((64, 64, 3)), dot)
    assert abs(map_.mean() - 0.003493) < 2e-6 and abs(map_.max() - 0.864907) < 2e-6


class Table:
    """The values that were computed twice."""

    def __init__(self):
        self.agrees = True
        print(f"{'what':<44}{'rend':>16}{'here':>16}{'difference':>12}{'allowed':>10}")

    def add(self, what, rend, here, allowed, scale=1):
        difference = abs(rend - here) / scale
        self.agrees = self.agrees and difference <= allowed
        print(f"{what:<44}{rend:>16.9g}{here:>16.9g}{difference:>12.1e}{allowed:>10.0e}"
              f"{'' if difference <= allowed else '  DISAGREES'}")


def pictures():
    """By name, pairs of what is written to the files and the levels (0 to 255) that this means."""
    random = np.random.default_rng(1)
    noise = random.integers(0, 256, (70, 90, 3), dtype=np.uint8)
    ramp = np.add.outer(2 * np.arange(80), np.arange(120)).astype(np.uint8)
    drawn = np.stack([ramp, ramp[::-1], 255 - ramp], axis=-1)
    patch, moved = drawn.copy(), np.roll(drawn, 1, axis=1)
    patch[20:33, 50:60] = (250, 20, 30)
    near = np.clip(noise.astype(int) + random.integers(-9, 10, noise.shape), 0, 255).astype(np.uint8)
    yield "noise and noise near it", (noise, noise), (near, near)
    yield "a patch", (drawn, drawn), (patch, patch)
    yield "shifted by a pixel", (drawn, drawn), (moved, moved)
    grey = np.repeat(ramp[..., None], 3, axis=-1)
    yield "grey and colour", (ramp, grey), (drawn, drawn)
    few = (drawn // 64 * 64)
    palette = Image.fromarray(few).convert("P", palette=Image.Palette.ADAPTIVE, colors=64)
    yield "palette", (palette, np.asarray(palette.convert("RGB"))), (drawn, drawn)
    deep = [random.integers(0, 65536, (40, 50, 3), dtype=np.uint16)]
    noisy = deep[0].astype(int) + random.integers(-90, 91, deep[0].shape)
    deep.append(np.clip(noisy, 0, 65535).astype(np.uint16))
    deep = [(dict(samples=d, bits=16, colour=2, interlaced=n == 1), d / 257) for n, d in enumerate(deep)]
    yield "16 bits, one interlaced", *deep
    yield "16 bits and 8", deep[0], (noise[:40, :50], noise[:40, :50])
    yield "interlaced", (dict(samples=drawn, bits=8, colour=2, interlaced=True), drawn), (patch, patch)
    yield ("1 bit", (Image.fromarray(ramp > 99), np.repeat((ramp > 99)[..., None], 3, axis=-1) * 255.),
           (grey, grey))
    alpha = random.integers(0, 256, (80, 120, 1), dtype=np.uint8)
    on_white = drawn * (alpha / 255) + (255 - alpha.astype(float))
    grey_on_white = grey * (alpha / 255) + (255 - alpha.astype(float))
    grey_alpha = np.stack([ramp, alpha[..., 0]], axis=-1)
    yield ("grey and alpha", (dict(samples=grey_alpha, bits=8, colour=4, interlaced=True), grey_on_white),
           (drawn, drawn))
    yield "alpha", (np.concatenate([drawn, alpha], axis=-1), on_white), (drawn, drawn)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: recompute.py REND")
    check_flip()
    table = Table()
    with tempfile.TemporaryDirectory() as folder:
        for name, *pair in pictures():
            files = [Path(folder) / side for side in ("a.png", "b.png")]
            for file, (stored, _) in zip(files, pair):
                if isinstance(stored, Image.Image):
                    stored.save(file)
                elif isinstance(stored, dict): # a format that PIL cannot write
                    write_png(file, **stored)
                else:
                    Image.fromarray(stored).save(file)
            done = subprocess.run([sys.argv[1], "diff", *files, "--json"], capture_output=True, text=True)
            if done.returncode != 1:
                sys.exit(f"rend diff ended with {done.returncode}: {done.stderr}")
            found = json.loads(done.stdout)["cases"][0]["figures"]
            a, b = (np.asarray(levels, dtype=float) for _, levels in pair)
            table.add(f"{name}: SSIM", found["ssim"],
                      metrics.structural_similarity(a, b, channel_axis=-1, data_range=255),
                      1e-6)
            if "alpha" not in name: # there alpha counts as a channel of its own
                rmse = np.sqrt(metrics.mean_squared_error(a, b))
                psnr = metrics.peak_signal_noise_ratio(a, b, data_range=255)
                table.add(f"{name}: RMSE", found["rmse"], rmse, 1e-6, scale=rmse) # relative: levels and dB
                table.add(f"{name}: PSNR", found["psnr"], psnr, 1e-6, scale=psnr)
            map_ = flip(a, b)
            table.add(f"{name}: FLIP", found["flip"]["mean"], map_.mean(), 5e-5)
            table.add(f"{name}: largest FLIP", found["flip"]["max"], map_.max(), 5e-5)
            table.add(f"{name}: weighted median of FLIP", found["flip"]["weighted_median"],
                      weighted_percentile(map_, 50),
                      5e-5)
            table.add(f"{name}: weighted quartile of FLIP", found["flip"]["weighted_quartile_3"],
                      weighted_percentile(map_, 75), 5e-5)
    sys.exit(0 if table.agrees else 1)


def write_png(file, samples, bits, colour, interlaced):
    """A PNG file by the specification: bits 8 or 16, colour 0 (grey), 2 (RGB), 4 (grey, alpha) or 6 (RGBA)."""
    height, width = samples.shape[:2]
    if interlaced: # Adam7: first column and row, and their steps
        passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2),
                  (0, 1, 1, 2)]
    else:
        passes = [(0, 0, 1, 1)]
    rows = b"".join(b"\0" + row.astype(f">u{bits // 8}").tobytes() for x, y, dx, dy in passes
                    for row in samples[y::dy, x::dx] if row.size)
    number = lambda value: struct.pack(">I", value)
    chunk = lambda kind, data: number(len(data)) + kind + data + number(zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, int(interlaced))
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) +
                     chunk(b"IEND", b""))


main()
