#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# Writes a glTF scene with one ball for each material extension that docs/scenes.md describes:
#   docs/materials_scene.py materials.gltf
import array
import base64
import json
import math
import sys

BALLS = [  # from the left, back row first
    {"pbrMetallicRoughness": {"baseColorFactor": [0.3, 0.02, 0.02, 1], "roughnessFactor": 0.35, "metallicFactor": 0},
     "extensions": {"KHR_materials_specular": {"specularColorFactor": [0.5, 1.5, 6]}, "KHR_materials_ior": {"ior": 1.6}}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.03, 0.02, 1], "roughnessFactor": 0.5, "metallicFactor": 0.7},
     "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.05, 0.02, 0.2, 1], "roughnessFactor": 0.9, "metallicFactor": 0},
     "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.5, 1], "sheenRoughnessFactor": 0.4}}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.7, 0.45, 1], "roughnessFactor": 0.25, "metallicFactor": 1},
     "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.8}}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "roughnessFactor": 0.2, "metallicFactor": 1},
     "extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.6,
                                                  "iridescenceThicknessMaximum": 420}}},
    {"pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0},
     "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                    "KHR_materials_volume": {"thicknessFactor": 1}, "KHR_materials_ior": {"ior": 1.7},
                    "KHR_materials_dispersion": {"dispersion": 4}}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.1, 1], "roughnessFactor": 0.6, "metallicFactor": 0},
     "doubleSided": True,
     "extensions": {"KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.7,
                                                           "diffuseTransmissionColorFactor": [0.8, 0.9, 0.2]}}},
    {"pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0},
     "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.33},
                    "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.5,
                                                  "iridescenceThicknessMaximum": 550}}},
]


def matt(color):
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "roughnessFactor": 1, "metallicFactor": 0}}


def lamp(strength):
    return {"emissiveFactor": [1, 0.97, 0.92], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}}


class File:
    def __init__(self):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": [], "buffers": []}

    def accessor(self, code, type_name, values, extra=None):
        data = array.array(code, values).tobytes()
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[type_name]
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1,
                                       "componentType": {"f": 5126, "I": 5125}[code], "type": type_name,
                                       "count": len(values) // width, **(extra or {})})
        return len(self.json["accessors"]) - 1

    def geometry(self, positions, normals, uvs, triangles):
        flat = [x for p in positions for x in p]
        low = [min(p[i] for p in positions) for i in range(3)]
        high = [max(p[i] for p in positions) for i in range(3)]
        return {"attributes": {"POSITION": self.accessor("f", "VEC3", flat, {"min": low, "max": high}),
                               "NORMAL": self.accessor("f", "VEC3", [x for n in normals for x in n]),
                               "TEXCOORD_0": self.accessor("f", "VEC2", [x for t in uvs for x in t])},
                "indices": self.accessor("I", "SCALAR", triangles)}

    def add(self, geometry, material, place=(0, 0, 0)):
        self.json["materials"].append(material)
        self.json["meshes"].append({"primitives": [{**geometry, "material": len(self.json["materials"]) - 1}]})
        self.json["nodes"].append({"mesh": len(self.json["meshes"]) - 1, "translation": list(place)})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def save(self, path):
        used = sorted({name for m in self.json["materials"] for name in m.get("extensions", {})})
        self.json["extensionsUsed"] = used
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
        self.json["buffers"] = [{"byteLength": len(self.bytes), "uri": uri}]
        with open(path, "w") as out:
            json.dump(self.json, out)


def ball(file, radius, rings=96):
    points, normals, uvs, triangles = [], [], [], []
    columns = 2 * rings
    for row in range(rings + 1):
        for column in range(columns + 1):
            u, v = column / columns, row / rings
            n = (math.sin(math.pi * v) * math.sin(2 * math.pi * u), math.cos(math.pi * v),
                 math.sin(math.pi * v) * math.cos(2 * math.pi * u))
            points.append([radius * x for x in n])
            normals.append(n)
            uvs.append((u, v))
    for row in range(rings):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            triangles += [a, b, a + 1] * (row > 0) + [a + 1, b, b + 1] * (row < rings - 1)
    return file.geometry(points, normals, uvs, triangles)


def rectangle(file, corner, a, b):
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    size = math.sqrt(sum(x * x for x in cross))
    points = [[corner[i] + s * a[i] + t * b[i] for i in range(3)] for s, t in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return file.geometry(points, [[x / size for x in cross]] * 4, [(0, 1), (1, 1), (1, 0), (0, 0)], [0, 1, 2, 0, 2, 3])


def main():
    file = File()
    radius = 0.45
    shape = ball(file, radius)
    for i, material in enumerate(BALLS):
        back = i < 4
        file.add(shape, material, ((i % 4 - 1.5) * 1.15, radius + (0.75 if back else 0), -1.1 if back else 0))
    file.add(rectangle(file, (-2.4, 0.75, -0.6), (4.8, 0, 0), (0, 0, -1)), matt((0.4, 0.4, 0.4)))  # a shelf
    for i in range(24):  # its front has stripes, for glass to bend
        shade = 0.6 if i % 2 else 0.08
        file.add(rectangle(file, (-2.4 + 0.2 * i, 0, -0.6), (0.2, 0, 0), (0, 0.75, 0)), matt([shade] * 3))
    for x in range(-6, 6):  # a floor of tiles
        for z in range(-6, 4):
            shade = 0.5 if (x + z) % 2 else 0.15
            file.add(rectangle(file, (x * 0.5, 0, z * 0.5 + 0.5), (0.5, 0, 0), (0, 0, -0.5)), matt([shade] * 3))
    file.add(rectangle(file, (-4, 0, -3), (8, 0, 0), (0, 4, 0)), matt((0.3, 0.33, 0.38)))
    file.add(rectangle(file, (-2.6, 3, -1), (0, 0, 2), (1.6, 0, 0)), lamp(14))  # above, on the left
    file.add(rectangle(file, (3, 0.4, 1.5), (0, 1.8, 0), (0, 0, -2.4)), lamp(5))  # on the right
    file.save(sys.argv[1])


main()
