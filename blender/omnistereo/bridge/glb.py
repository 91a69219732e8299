# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""A binary glTF file, read whole and changed in place."""
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
        self.json, self.binary = {}, bytearray()
        at = 12
        while at < len(data):
            size, kind = struct.unpack_from("<II", data, at)
            chunk = data[at + 8 : at + 8 + size]
            if kind == _JSON:
                self.json = json.loads(chunk)
            if kind == _BIN:
                self.binary = bytearray(chunk)
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

    def add_view(self, data):
        while len(self.binary) % 4:
            self.binary.append(0)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        self.binary += data
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
        return np.frombuffer(self.binary, "<f4", count, start).reshape(-1, width).copy()

    def add_root(self, node):
        index = self.append("nodes", node)
        scene = self.list("scenes")[self.json.get("scene", 0)]
        scene.setdefault("nodes", []).append(index)
        return index

    def save(self, path):
        while len(self.binary) % 4:
            self.binary.append(0)
        if self.binary:
            self.json["buffers"] = [{"byteLength": len(self.binary)}]
        for name in [key for key, value in self.json.items() if value == []]:
            del self.json[name]
        text = json.dumps(self.json, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + (8 + len(self.binary) if self.binary else 0)
        with open(path, "wb") as file:
            file.write(struct.pack("<III", _MAGIC, 2, size))
            file.write(struct.pack("<II", len(text), _JSON) + text)
            if self.binary:
                file.write(struct.pack("<II", len(self.binary), _BIN) + self.binary)
