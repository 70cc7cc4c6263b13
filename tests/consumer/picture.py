#!/usr/bin/python3
"""Whether a picture shows a red cloth that hangs between two sides and is torn in two.

    picture.py PICTURE

The cloth is the only thing in it that is red: so it is where red is well above green and blue.
"""
import sys

import numpy as np
from PIL import Image

rgb = np.asarray(Image.open(sys.argv[1]).convert("RGB")).astype(int)
red = (rgb[..., 0] > rgb[..., 1] + 40) & (rgb[..., 0] > rgb[..., 2] + 40)
share = red.mean()
columns = np.flatnonzero(red.any(axis=0))
# The widest run of columns without cloth, between others that have some.
gap = np.diff(columns).max() - 1 if len(columns) > 1 else 0
print(f"{share:.1%} of the picture is cloth; the parts are {gap} pixels apart")
if not 0.03 < share < 0.9:
    sys.exit("the picture does not show the cloth")
if gap < rgb.shape[1] / 50:
    sys.exit("the cloth in the picture is whole")
