# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""A binary glTF file, read whole and added to."""
import bisect
import json
import struct

import numpy as np

FLOAT = 5126
UNSIGNED_SHORT = 5123
UNSIGNED_INT = 5125

_MAGIC, _JSON, _BIN = 0x46546C67, 0x4E4F534A, 0x004E4942
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_TYPES = {FLOAT: "<f4", UNSIGNED_SHORT: "<u2", UNSIGNED_INT: "<u4"}


class Glb:
    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        self.json, self.pieces, self.size = {}, [], 0  # pieces: of its buffer, of this size together
        at = 12
        while at < len(data):
            size, kind = struct.unpack_from("<II", data, at)
            chunk = data[at + 8 : at + 8 + size]
            if kind == _JSON:
                self.json = json.loads(chunk)
            if kind == _BIN:
                self._add_bytes(chunk)
            at += 8 + size

    def list(self, name):
        return self.json.setdefault(name, [])

    def append(self, name, value):
        self.list(name).append(value)
        return len(self.list(name)) - 1

    def use(self, extension):
        used = self.list("extensionsUsed")
        if extension not in used:
            used.append(extension)

    def _add_bytes(self, data):
        """A multiple of four. What is there stays where it is: an animation may have gigabytes."""
        self.pieces.append((self.size, data + b"\0" * (-len(data) % 4)))
        self.size += len(self.pieces[-1][1])

    def add_view(self, data):
        view = {"buffer": 0, "byteOffset": self.size, "byteLength": len(data)}
        self._add_bytes(data)
        return self.append("bufferViews", view)

    def add_accessor(self, values, kind, component=FLOAT):
        """values: numbers in any nesting; kind: SCALAR, VEC3, ..."""
        array = np.asarray(values, dtype=_TYPES[component]).reshape(-1, _WIDTHS[kind])
        accessor = {
            "bufferView": self.add_view(array.tobytes()),
            "componentType": component,
            "count": len(array),
            "type": kind,
            "min": array.min(axis=0).tolist(),
            "max": array.max(axis=0).tolist(),
        }
        return self.append("accessors", accessor)

    def read_floats(self, index):
        """The values of an accessor of floats without stride, as the exporter writes them."""
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        width = _WIDTHS[accessor["type"]]
        count = accessor["count"] * width
        at, piece = self.pieces[bisect.bisect_right(self.pieces, start, key=lambda p: p[0]) - 1]
        return np.frombuffer(piece, "<f4", count, start - at).reshape(-1, width).copy()

    def add_root(self, node):
        index = self.append("nodes", node)
        scene = self.list("scenes")[self.json.get("scene", 0)]
        scene.setdefault("nodes", []).append(index)
        return index

    def save(self, path):
        if self.size:
            self.json["buffers"] = [{"byteLength": self.size}]
        for name in [key for key, value in self.json.items() if value == []]:
            del self.json[name]
        text = json.dumps(self.json, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + (8 + self.size if self.size else 0)
        with open(path, "wb") as file:
            file.write(struct.pack("<III", _MAGIC, 2, size))
            file.write(struct.pack("<II", len(text), _JSON) + text)
            if self.size:
                file.write(struct.pack("<II", self.size, _BIN))
            for _, piece in self.pieces:
                file.write(piece)
