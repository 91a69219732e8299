#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Writes small glTF files that together use every feature of the reader: make_seeds.py FOLDER"""
import base64, io, json, os, struct, sys, zipfile, zlib


def png():
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes([255, 128, 0, 255] * 2) for _ in range(2))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 6, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def buffers(document, binary, **first):
    """The buffer with the data, followed by one without data if anything is compressed."""
    fallback = {"byteLength": 1 << 16, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}
    compressed = any("extensions" in view for view in document["bufferViews"])
    document["buffers"] = [{"byteLength": len(binary), **first}] + [fallback] * compressed


def glb(document, binary):
    buffers(document, binary)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    size = 28 + len(text) + len(binary)
    return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def quad(indices=True, normals=True, mode=4):
    positions = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
    parts = [positions, struct.pack("<12f", *([0, 0, 1] * 4)), struct.pack("<8f", 0, 1, 1, 1, 1, 0, 0, 0),
             struct.pack("<16B", *([255, 128, 0, 255] * 4)), struct.pack("<6H", 0, 1, 2, 0, 2, 3), png()]
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                 {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
                 {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
                 {"bufferView": 3, "componentType": 5121, "normalized": True, "count": 4, "type": "VEC4"},
                 {"bufferView": 4, "componentType": 5123, "count": 6, "type": "SCALAR"}]
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 2, "COLOR_0": 3}, "mode": mode}
    if indices:
        primitive["indices"] = 4
    if normals:
        primitive["attributes"]["NORMAL"] = 1
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [primitive]}], "accessors": accessors, "bufferViews": views}, b"".join(parts)


def moving():
    """A skinned and morphed quad, a light and a material, each moved in one of the three ways."""
    document, binary = quad()

    def add(data, component, count, kind):
        nonlocal binary
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, "componentType": component,
                                      "count": count, "type": kind})
        binary += data + b"\0" * (-len(data) % 4)
        return len(document["accessors"]) - 1

    def floats(kind, *values):
        size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind]
        return add(struct.pack(f"<{len(values)}f", *values), 5126, len(values) // size, kind)

    binary += b"\0" * (-len(binary) % 4)
    primitive = document["meshes"][0]["primitives"][0]
    primitive["attributes"]["JOINTS_0"] = add(bytes([0, 1, 0, 0] * 4), 5121, 4, "VEC4")
    primitive["attributes"]["WEIGHTS_0"] = floats("VEC4", *([0.5, 0.5, 0, 0] * 4))
    primitive["targets"] = [{"POSITION": 1, "NORMAL": 1}, {"POSITION": 1}]
    primitive["material"] = 0
    one = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    document["materials"] = [{"emissiveFactor": [1, 1, 1]}]
    document["skins"] = [{"joints": [1, 2], "inverseBindMatrices": floats("MAT4", *one, *one)}]
    document["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
    document["scenes"] = [{"nodes": [0, 1]}]
    document["nodes"] = [{"mesh": 0, "skin": 0}, {"children": [2]},
                         {"translation": [1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}]
    times = floats("SCALAR", 0, 1)
    pointer = lambda path: {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": path}}}
    moves = [({"node": 2, "path": "rotation"}, "LINEAR", floats("VEC4", 0, 0, 0, 1, 0, 1, 0, 0)),
             ({"node": 1, "path": "translation"}, "CUBICSPLINE", floats("VEC3", *range(18))),
             ({"node": 0, "path": "weights"}, "STEP", floats("SCALAR", 0, 1, 1, 0)),
             (pointer("/extensions/KHR_lights_punctual/lights/0/intensity"), "LINEAR", floats("SCALAR", 1, 2)),
             (pointer("/materials/0/emissiveFactor"), "LINEAR", floats("VEC3", 1, 1, 1, 0, 0, 0))]
    document["animations"] = [{
        "samplers": [{"input": times, "output": output, "interpolation": how} for _, how, output in moves],
        "channels": [{"sampler": i, "target": target} for i, (target, _, _) in enumerate(moves)]}]
    return document, binary


# A bumpy grid of two by two quads, compressed by libdraco (positions, normals, texture coordinates, colours) ...
DRACO = {
    "sequential":
        "RFJBQ08CAgEAAAAICQEAAwEBAwQBBAICBAUDBgQEBgcEBwUFBwgBBAAJAwAAAQkDAAEDCQIAAgICBAEDAAAAAQAAAAAAAAAAAAAA"
        "AAAAgD8AAAAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAAAAAACAPwAAgD/NzMw9AACAPwAAAEDNzEw+AACAPwAAAAAAAAAAAAAAQAAA"
        "gD/NzEw+AAAAQAAAAEDNzMw+AAAAQAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAA"
        "AIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAPwAAAAAAAIA/"
        "AAAAAAAAAAAAAAA/AAAAPwAAAD8AAIA/AAAAPwAAAAAAAIA/AAAAPwAAgD8AAIA/AACAPwABAQECgAKpKskB/7eRA/9bOQ7XyQEJ"
        "mk24gIKvErWAAAAAAP8AAAA=",
    "edgebreaker":
        "RFJBQ08CAgEBAAAACQgDCAEAA+/TGv8BEf8CiED/AohA/wKIQAT/AAAAAAABAAACAAABAAkDAAACAQEJAwABAwEDCQIAAgIBAgIE"
        "AQMBAQEBAAwDHQcXkSMHVRUEb2o+hP9nxv/9v4z/9x8AAAhYBgDAMgCAMwDAMgCAMgAAAAAA/wcAAAAAAAAAAAAAAAAAAAAAAEAL"
        "AAMBAQGAAXE8//eRAwPgv4r/AAAAfwAAAAgBAQEACwOtKh9VFQMqYkz//+////0DEAAAAAAA/wMAAAAAAAAAAAAAAACAPwoBAQEB"
        "AoACjTPJAf///xORA1UF18kBB6LGMvQQ/5MAAAAA/wAAAA==",
    "valence":
        "RFJBQ08CAgEBAAAACQgDCAEAA+/TGv8BEf8CiED/AohA/wKIQAT/AAEAAAABAAACAAABAAkDAAACAQEJAwABAwEDCQIAAgIBAgIE"
        "AQMBAQEBAAwDHQcXkSMHVRUEb2o+hP9nxv/9v4z/9x8AAAhYBgDAMgCAMwDAMgCAMgAAAAAA/wcAAAAAAAAAAAAAAAAAAAAAAEAL"
        "BgMBAAkDHQcX5TgDNcWFDOkR6QnzBfMcpDuER4RPaAP/AAAAfwAAAP8CmUAIBQEBAAsDVRUDHQdZFRM5DgRl+Mx////v//8BAz9I"
        "AgcAAAABAnBAAAAAAP8DAAAAAAAAAAAAAAAAgD8KAQEBAQWAAo0zyQH///8TkQNVBdfJAQeixjL0EP+TAAAAAP8AAAA=",
}
# ... and by libmeshoptimizer: its positions and triangles, normals and rotations with their filters.
MESHOPT = {
    "positions": ("ATTRIBUTES", 12, 9, "NONE",
        "oAAAATzzwAD///////8BO++AAH5/fn9+AQDPAABlZmUBAM8AAGdoZwEA/8AAZ/+XmP8BAO8AAHp7fAAAAQMMAAD//wEDCAAAfgAA"
        "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"),
    "triangles": ("TRIANGLES", 4, 24, "NONE",
        "4P4fAB9fDwIf8AYCAgICAgB2h1ZneKmGZYlomAFpAAA="),
    "sequence": ("INDICES", 4, 24, "NONE",
        "0AAMBgAIBAoMBgAIBAYMBgAIBAoMBgAIBAAAAAA="),
    "oct": ("ATTRIBUTES", 4, 9, "OCTAHEDRAL",
        "oAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAH9/AA=="),
    "quat": ("ATTRIBUTES", 8, 9, "QUATERNION",
        "oAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAJxs/38="),
    "exp": ("ATTRIBUTES", 12, 9, "EXPONENTIAL",
        "oAABM8/AAIB/gH9AQAABKSAAAAEAz8AAzMvMzgEAz8AADAsMDAABKSAAAAABAzwAAIA/QAABKSAAAAAAAAAAAAAAAAAAAAAAAAAA"
        "AAAAAAAA8QAAAPEAAADx"),
}


def accessor(component, count, kind, **more):
    return {"componentType": component, "count": count, "type": kind, **more}


def with_draco(name):
    stream = base64.b64decode(DRACO[name])
    document = quad()[0]
    document["accessors"] = [accessor(5126, 9, "VEC3"), accessor(5126, 9, "VEC3"), accessor(5126, 9, "VEC2"),
                             accessor(5121, 9, "VEC4", normalized=True), accessor(5123, 24, "SCALAR")]
    document["bufferViews"] = [{"buffer": 0, "byteLength": len(stream)}]
    document["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": {
        "bufferView": 0, "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3}}}
    document["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return document, stream


def with_meshopt(positions, corners, extension):
    document, binary = quad()[0], b""
    document["bufferViews"] = []
    for name in (positions, "oct", "quat", corners):
        mode, stride, count, kind, text = MESHOPT[name]
        stream = base64.b64decode(text)
        document["bufferViews"].append({"buffer": 1, "byteLength": stride * count, "extensions": {extension: {
            "buffer": 0, "byteOffset": len(binary), "byteLength": len(stream), "byteStride": stride, "count": count,
            "mode": mode, "filter": kind}}})
        if name == "oct":
            document["bufferViews"][-1]["byteStride"] = stride
        binary += stream
    document["accessors"] = [accessor(5126, 9, "VEC3", bufferView=0),
                             accessor(5120, 9, "VEC3", bufferView=1, normalized=True),
                             accessor(5122, 9, "VEC4", bufferView=2, normalized=True),
                             accessor(5125, 24, "SCALAR", bufferView=3)]
    document["meshes"][0]["primitives"][0] = {"attributes": {"POSITION": 0, "NORMAL": 1, "COLOR_0": 2}, "indices": 3}
    return document, binary


def archives():
    """Archives with a scene in them: alone, and with its files beside it."""
    def archive(files):
        whole = io.BytesIO()
        with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as out:
            for name, data in files.items():
                out.writestr(name, data)
        return whole.getvalue()
    document, binary = quad()
    yield "alone", archive({"readme.txt": "hello", "a/scene.glb": glb(document, binary)})
    document["buffers"] = [{"byteLength": len(binary), "uri": "Scene%20data.bin"}]
    document["images"] = [{"uri": "textures\\wood.png"}]
    document["textures"] = [{"source": 0}]
    document["materials"] = [{"emissiveTexture": {"index": 0}}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    yield "beside", archive({"a/scene.gltf": json.dumps(document), "a/scene data.bin": binary,
                             "a/textures/wood.png": png(), "__MACOSX/._scene.gltf": "x"})


def as_reals(value):
    """The document with every whole number written as a real."""
    if isinstance(value, dict):
        return {key: as_reals(member) for key, member in value.items()}
    if isinstance(value, list):
        return [as_reals(member) for member in value]
    return float(value) if type(value) is int else value


def odd_texts():
    """Unusual JSON: valid, strange and broken."""
    asset = '"asset":{"version":"2.0"}'
    yield "extras", "{%s,\"extras\":[%s{}]}" % (asset, "0,[],{}," * 20)
    yield "nested", "{%s,\"extras\":%s%s}" % (asset, "[" * 90, "]" * 90)
    yield "too-deep", "{%s,\"nodes\":%s" % (asset, "[{\"extras\":" * 60)
    yield "twice", '{%s,"nodes":[{"mesh":0,"mesh":1}],"nodes":[{}],"asset":{"version":"2.0"}}' % asset
    yield "nulls", '{%s,"nodes":[{"mesh":null,"children":null,"extensions":null}],"scenes":null,"scene":null}' % asset
    yield "kinds", '{%s,"nodes":[{"mesh":"0","children":{},"matrix":5,"rotation":[[],"x",0,1]}],"meshes":[{}]}' % asset
    yield "numbers", '{%s,"nodes":[{"mesh":-0,"scale":[1e308,-1e-308,0.1e+2],"skin":18446744073709551616}]}' % asset
    yield "infinite", '{%s,"nodes":[{"scale":[1e999,1,1]}]}' % asset
    yield "strings", '{%s,"nodes":[{"name":"\\u0000\\ud83d\\ude00\\n\\u001b[31m"}],"x\\u0000y":1}' % asset
    yield "surrogate", '{%s,"nodes":[{"name":"\\ud83d"}]}' % asset
    yield "cut", '{%s,"nodes":[{"name":"a' % asset
    yield "comma", '{%s,"nodes":[{},],}' % asset
    yield "after", "{%s} {}" % asset
    yield "empties", '{%s,"nodes":[%s{}],"accessors":[{},{}],"materials":[{}],"meshes":[{}]}' % (asset, "{}," * 40)
    for i, uri in enumerate(["../a.bin", "%2e%2e/a.bin", "/etc/passwd", "file:///etc/passwd", "%00", "", "data:,"]):
        yield f"uri{i}", '{%s,"buffers":[{"byteLength":1,"uri":"%s"}],"images":[{"uri":"%s"}]}' % (asset, uri, uri)


def seeds():
    yield "triangles", quad()
    yield "flat", quad(normals=False)
    yield "strip", quad(indices=False, mode=5)
    yield "fan", quad(indices=False, mode=6)
    document, binary = quad()
    document["accessors"][0]["sparse"] = {"count": 1, "indices": {"bufferView": 4, "componentType": 5123},
                                          "values": {"bufferView": 1}}
    yield "sparse", (document, binary)
    document, binary = quad()
    slot = {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2]}}}
    document["images"] = [{"bufferView": 5, "mimeType": "image/png"},
                          {"uri": "data:image/png;base64," + base64.b64encode(png()).decode()}]
    document["samplers"] = [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}]
    document["textures"] = [{"source": 0, "sampler": 0}, {"source": 1, "extensions": {"EXT_texture_webp": {"source": 0}}}]
    document["materials"] = [{
        "pbrMetallicRoughness": {"baseColorTexture": slot, "metallicRoughnessTexture": {"index": 1}, "roughnessFactor": 0.3},
        "normalTexture": {"index": 1, "scale": 0.5}, "emissiveTexture": slot, "emissiveFactor": [1, 1, 1],
        "alphaMode": "MASK", "alphaCutoff": 0.4, "doubleSided": True,
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 5}, "KHR_materials_ior": {"ior": 1.4},
                       "KHR_materials_unlit": {},
                       "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": {"index": 0}},
                       "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2,
                                                "attenuationColor": [1, 0.5, 0.5]}}}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    yield "material", (document, binary)
    document, binary = quad()
    spot = {"type": "spot", "intensity": 10, "color": [1, 1, 0.5], "range": 9,
            "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}
    document["extensions"] = {"KHR_lights_punctual": {"lights": [spot, {"type": "point"}, {"type": "directional"}]}}
    document["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
    instancing = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "SCALE": 0, "ROTATION": 3}}}
    document["nodes"] = [{"children": [1, 2], "matrix": [1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]},
                         {"mesh": 0, "extensions": instancing},
                         {"camera": 0, "rotation": [0, 0.7, 0, 0.7], "scale": [1, 1, 2], "translation": [1, 0, 0],
                          "extensions": {"KHR_lights_punctual": {"light": 0}}}]
    yield "nodes", (document, binary)
    yield "moving", moving()
    document, binary = moving()
    yield "reals", (as_reals(document), binary)
    document, binary = quad()
    document["accessors"][2].pop("bufferView")
    document["accessors"][4] = {"componentType": 5123, "count": 6, "type": "SCALAR", "sparse": {
        "count": 4, "indices": {"bufferView": 4, "byteOffset": 2, "componentType": 5123}, "values": {"bufferView": 4}}}
    yield "zeros", (document, binary)
    for name in DRACO:
        yield "draco-" + name, with_draco(name)
    yield "meshopt", with_meshopt("positions", "triangles", "EXT_meshopt_compression")
    yield "meshopt-filters", with_meshopt("exp", "sequence", "KHR_meshopt_compression")


os.makedirs(sys.argv[1], exist_ok=True)
for name, text in odd_texts():
    with open(os.path.join(sys.argv[1], name + ".gltf"), "w") as file:
        file.write(text)
for name, (document, binary) in seeds():
    with open(os.path.join(sys.argv[1], name + ".glb"), "wb") as file:
        file.write(glb(document, binary))
    data = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    buffers(document, binary, uri=data)
    with open(os.path.join(sys.argv[1], name + ".gltf"), "w") as file:
        json.dump(document, file)
for name, data in archives():
    with open(os.path.join(sys.argv[1], name + ".zip"), "wb") as file:
        file.write(data)
