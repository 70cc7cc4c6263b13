#!/usr/bin/python3
"""Reads binary .ply files by their headers, and prints their content: one JSON object per line.

(meshio 5.3 reads scalar properties of faces as if they were stored after all lists, which is not the format.)
"""
import json
import struct
import sys

FORMATS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f",
           "double": "d"}


def header(file):
    assert file.readline() == b"ply\n"
    assert file.readline() == b"format binary_little_endian 1.0\n"
    comments, elements = [], []
    for line in iter(file.readline, b"end_header\n"):
        word, *rest = line.decode().split()
        if word == "comment":
            comments.append(" ".join(rest))
        elif word == "element":
            elements.append((rest[0], int(rest[1]), []))
        else:
            assert word == "property"
            elements[-1][2].append(rest)
    return comments, elements


def number(file, kind):
    size = struct.calcsize("<" + FORMATS[kind])
    return struct.unpack("<" + FORMATS[kind], file.read(size))[0]


def value(file, words):
    if words[0] != "list":
        return number(file, words[0])
    return [number(file, words[2]) for _ in range(number(file, words[1]))]


for name in sys.argv[1:]:
    with open(name, "rb") as file:
        comments, elements = header(file)
        result = {"comments": comments}
        for element, count, properties in elements:
            rows = [[value(file, words) for words in properties] for _ in range(count)]
            result[element] = {words[-1]: [row[n] for row in rows] for n, words in enumerate(properties)}
        assert file.read() == b"", "bytes behind the last element"
    print(json.dumps(result, allow_nan=False))
