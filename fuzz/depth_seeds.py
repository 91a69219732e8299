#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Writes small depth files for fuzz/depth_reader.cpp, each after a byte of options: depth_seeds.py FOLDER"""
import os, struct, sys, zlib

WIDTH, HEIGHT = 16, 8
DEPTH = [1.6 / max(0.05, (y - 3.5) / 4) if y > 3 else 5.0 + x % 5 for y in range(HEIGHT) for x in range(WIDTH)]


def pfm(order, kind="Pf"):
    sign = "-1.0" if order == "<" else "1.0"
    numbers = [value for value in DEPTH for _ in range(3 if kind == "PF" else 1)]
    return f"{kind}\n{WIDTH} {HEIGHT}\n{sign}\n".encode() + struct.pack(f"{order}{len(numbers)}f", *numbers)


def npy(word, letter, scale=1, shape=f"({HEIGHT}, {WIDTH})", fortran=False):
    head = f"{{'descr': '{word}', 'fortran_order': {fortran}, 'shape': {shape}, }}".encode()
    head += b" " * (-(len(head) + 11) % 64) + b"\n"
    numbers = [value * scale if letter in "fde" else int(value * scale) for value in DEPTH]
    order = ">" if word[0] == ">" else "<"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(head)) + head + struct.pack(f"{order}{len(numbers)}{letter}", *numbers)


def png16():
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + struct.pack(f">{WIDTH}H", *(int(65535 / value) for value in DEPTH[y * WIDTH:(y + 1) * WIDTH]))
                    for y in range(HEIGHT))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


SEEDS = {"little.pfm": pfm("<"), "big.pfm": pfm(">"), "colour.pfm": pfm("<", "PF"), "float.npy": npy("<f4", "f"),
         "double.npy": npy(">f8", "d"), "half.npy": npy("<f2", "e"), "word.npy": npy("<u2", "H", 1000),
         "byte.npy": npy("|u1", "B", 10), "flat.npy": npy("<f4", "f", 1, f"(1, {HEIGHT}, {WIDTH}, 1)"),
         "columns.npy": npy("<f4", "f", 1, f"({HEIGHT}, {WIDTH})", True), "grey.png": png16()}

os.makedirs(sys.argv[1], exist_ok=True)
for name, data in SEEDS.items():
    for options in (0, 10, 27, 28, 34, 35):
        with open(f"{sys.argv[1]}/{options}-{name}", "wb") as file:
            file.write(bytes([options]) + data)
