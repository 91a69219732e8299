# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Inputs that nodes compute of the UV map alone, as pictures: Cycles renders the UV plane.

The picture covers what the meshes use of the plane. If that is wide and all is computed of pictures that repeat in one
layout, it covers one repetition.
"""
import os

import bpy
import numpy as np

from .looks import label_of, nodes_behind, output_of, principled_input, source_of
from .pictures import SRGB, has_pixels
from .stage import Stage, pixels

WIDEST = 4096  # of a picture, in pixels
USUAL = 1024  # pixels per unit of the UV map for textures that do not come from a picture
MOST_UNITS = 4.0

PURE = {
    "MIX", "MIX_RGB", "MATH", "VECT_MATH", "VALTORGB", "CURVE_RGB", "CURVE_VEC", "CURVE_FLOAT", "INVERT", "HUE_SAT",
    "GAMMA", "BRIGHTCONTRAST", "SEPRGB", "COMBRGB", "SEPARATE_COLOR", "COMBINE_COLOR", "SEPXYZ", "COMBXYZ", "SEPHSV",
    "COMBHSV",
    "MAPPING", "MAP_RANGE", "CLAMP", "RGBTOBW", "RGB", "VALUE", "BLACKBODY", "VECTOR_ROTATE", "UVMAP", "TEX_COORD",
    "TEX_IMAGE", "TEX_NOISE", "TEX_VORONOI", "TEX_WAVE", "TEX_CHECKER", "TEX_BRICK", "TEX_GRADIENT", "TEX_MAGIC",
    "TEX_MUSGRAVE", "TEX_WHITE_NOISE",
}


def _is_laid_out(node):
    """Whether something is linked to a texture's coordinates."""
    return source_of(node.inputs["Vector"]) is not None


def _other_source(node):
    """What a node reads besides the UV map and pictures over it, in Blender's words; None: nothing."""
    if node.type not in PURE or getattr(node, "projection", "FLAT") != "FLAT":
        return label_of(node)
    if node.type == "TEX_COORD":
        others = [o.name for o in node.outputs if o.is_linked and o.name != "UV"]
        return f"{others[0]} coordinates" if others else label_of(node) if node.from_instancer else None
    textured = node.type.startswith("TEX_") and node.type != "TEX_IMAGE"
    return label_of(node) if textured and not _is_laid_out(node) else None  # along the object


def other_sources(socket):
    """What of an input keeps it from being a picture over the UV map."""
    return {words for words in map(_other_source, nodes_behind(source_of(socket))) if words}


def _maps_of(nodes):
    """The UV maps that the nodes read; "": the one that is active. None: they read something else."""
    maps = set()
    for node in nodes:
        if _other_source(node) is not None:
            return None
        if node.type == "UVMAP":
            maps.add(node.uv_map)
        if node.type == "TEX_COORD" or (node.type == "TEX_IMAGE" and not _is_laid_out(node)):
            maps.add("")
    return maps


def is_constant_everywhere(socket):
    """Whether a linked input is computed of nothing that varies over a surface."""
    node = source_of(socket).node
    if node.type == "TEX_IMAGE" and not has_pixels(node):
        return True
    if node.type not in PURE or node.type.startswith("TEX_") or node.type == "UVMAP":
        return False
    return all(is_constant_everywhere(each) for each in node.inputs if source_of(each) is not None)


def _used_range(users, name, map_name):
    """The corners of what the meshes use of the UV plane; None: a mesh has no such map."""
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for each in users:
        mesh = each.data
        if each.type != "MESH" or not mesh.uv_layers:
            return None
        layer = mesh.uv_layers.get(map_name) if map_name else next((l for l in mesh.uv_layers if l.active_render), None)
        if layer is None:
            return None
        slots = [i for i, slot in enumerate(each.material_slots) if slot.material and slot.material.name == name]
        values = np.empty(2 * len(layer.data), np.float32)
        layer.data.foreach_get("uv", values)
        indices, totals = np.empty(len(mesh.polygons), np.int32), np.empty(len(mesh.polygons), np.int32)
        mesh.polygons.foreach_get("material_index", indices)
        mesh.polygons.foreach_get("loop_total", totals)
        own = values.reshape(-1, 2)[np.repeat(np.isin(indices, slots), totals)]
        if len(own) and np.isfinite(own).all():
            low, high = np.minimum(low, own.min(axis=0)), np.maximum(high, own.max(axis=0))
    return (low, high) if (high > low).all() else None


class Sheet:
    """What an input computes over a part of the UV plane, and what the file's picture of it is laid out by."""

    def __init__(self, source, maps, low, high, vector=None):
        self.source, self.map, self.low, self.high, self.vector = source, next(iter(maps)), low, high, vector
        textures = [n for n in nodes_behind(source) if n.type == "TEX_IMAGE" and n.image]
        sizes = [np.array(n.image.size) * (1.0 if vector is not None else _scale_of(n)) for n in textures]
        self.size = np.clip(np.ceil((high - low) * (np.max(sizes, axis=0) if sizes else USUAL)), 4, WIDEST).astype(int)


def _scale_of(node):
    """How often a Mapping repeats a picture in a unit of the UV map."""
    source = source_of(node.inputs["Vector"])
    if source is None or source.node.type != "MAPPING" or source.node.inputs["Scale"].is_linked:
        return 1.0
    scale = np.maximum(np.abs(source.node.inputs["Scale"].default_value[:2]), 1e-6)
    return np.maximum(1.0, 1.0 / scale if source.node.vector_type == "TEXTURE" else scale)


def _sheet(source, users, name, rules):
    """None: what it computes does not come of one UV map."""
    nodes = nodes_behind(source)
    maps = _maps_of(nodes)
    if maps is None or len(maps) != 1:
        return None
    found = _used_range(users, name, next(iter(maps)))
    if found is None:
        return None
    low, high = found
    if (high - low).max() <= MOST_UNITS:
        return Sheet(source, maps, low, high)
    textures = [n for n in nodes if n.type.startswith("TEX_") and n.type != "TEX_COORD"]
    vectors = {getattr(source_of(n.inputs["Vector"]), "node", None) for n in textures}
    repeat = all(n.type == "TEX_IMAGE" and n.image and n.extension == "REPEAT" for n in textures)
    if not repeat or len(vectors) != 1 or rules.layout_fault(textures[0].inputs["Vector"]) is not None:
        return None
    return Sheet(source, maps, np.zeros(2), np.ones(2), textures[0].inputs["Vector"])


def _plane(material, name, low, high):
    mesh = bpy.data.meshes.new("ods sheet")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)], [], [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new(name=name or "UVMap")
    for corner, place in zip(layer.data, ((0, 0), (1, 0), (1, 1), (0, 1))):
        corner.uv = low + np.array(place) * (high - low)
    mesh.materials.append(material)
    return bpy.data.objects.new("ods sheet", mesh)


def _rendered(sheet, material, folder):
    """height x width x 3, from the bottom up."""
    copy = material.copy()
    tree = copy.node_tree
    emission = tree.nodes.new("ShaderNodeEmission")
    source = tree.nodes[sheet.source.node.name].outputs[list(sheet.source.node.outputs).index(sheet.source)]
    tree.links.new(source, emission.inputs["Color"])
    tree.links.new(emission.outputs[0], output_of(tree).inputs["Surface"])
    if sheet.vector is not None:  # one repetition, without its mapping
        for node in tree.nodes:
            for link in list(node.inputs["Vector"].links) if node.type == "TEX_IMAGE" else []:
                tree.links.remove(link)
    plane = _plane(copy, sheet.map, sheet.low, sheet.high)
    stage = Stage()
    stage.scene.collection.objects.link(plane)
    width, height = (int(s) for s in sheet.size)
    render = stage.scene.render
    render.pixel_aspect_x, render.pixel_aspect_y = max(1.0, height / width), max(1.0, width / height)
    stage.camera.location = (0.5, -1.0, 0.5)
    stage.data.type, stage.data.ortho_scale = "ORTHO", 1.0
    stage.data.sensor_fit = "HORIZONTAL"
    path = os.path.join(folder, "sheet.exr")
    stage.render(path, width, height, 1)
    found = pixels(path)[..., :3]
    os.remove(path)
    stage.remove()
    mesh = plane.data
    bpy.data.batch_remove([plane, mesh, copy])
    return found


def _to_srgb(linear):
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055)


def picture_of(values, name, is_data, is_dithered):
    """An 8-bit picture of values from 0 to 1. Dithered, its dark parts keep their mean: a sun may be beside them."""
    height, width, _ = values.shape
    image = bpy.data.images.new(name, width, height, is_data=is_data)
    values = np.clip(values, 0.0, 1.0)
    texels = np.ones((height, width, 4), np.float32)
    texels[..., :3] = values if is_data else _to_srgb(values)
    if is_dithered:
        texels[..., :3] += (np.random.default_rng(1).random((height, width, 1)) - 0.5) / 255.0
    image.pixels.foreach_set(texels.ravel())
    image.pack()
    return image


def _layout(tree, sheet):
    """What lays the picture of a sheet out; None: the UV map itself."""
    if sheet.vector is not None:
        return source_of(sheet.vector)
    size = sheet.high - sheet.low
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Scale"].default_value = (*(1.0 / size), 1.0)
    mapping.inputs["Location"].default_value = (*(-sheet.low / size), 0.0)
    uv = tree.nodes.new("ShaderNodeUVMap" if sheet.map else "ShaderNodeTexCoord")
    if sheet.map:
        uv.uv_map = sheet.map
    tree.links.new(uv.outputs["UV"], mapping.inputs["Vector"])
    return mapping.outputs[0]


def unroll(material, node, keys, users, rules, folder):
    """Connects pictures of the inputs that the UV map alone computes."""
    tree, sheets = material.node_tree, []
    for key in keys:
        target = principled_input(node, key)
        if key == "normal":
            above = source_of(target).node
            if above.type != "NORMAL_MAP" or above.space != "TANGENT" or above.inputs["Strength"].is_linked:
                continue
            target = above.inputs["Color"]
        sheet = _sheet(source_of(target), users, material.name, rules)
        if sheet is not None:
            sheets.append((key, target, sheet))
    largest = np.max([sheet.size for _, _, sheet in sheets], axis=0) if sheets else None
    layouts = {}
    for key, target, sheet in sheets:
        sheet.size = largest  # of one size, as glTF has some of them in one picture
        values = _rendered(sheet, material, folder)
        peak = float(values.max())
        if key == "emission" and peak > 1.0:
            principled_input(node, "strength").default_value *= peak
            material["ods_peak"] = peak
            values = values / peak
        place = (sheet.map, *sheet.low, *sheet.high, None if sheet.vector is None else sheet.vector.node.name)
        if place not in layouts:
            layouts[place] = _layout(tree, sheet)
        picture = tree.nodes.new("ShaderNodeTexImage")
        picture.image = picture_of(values, f"{material.name} {key}", key not in SRGB, key == "emission" and peak > 1.0)
        picture.extension = "EXTEND" if sheet.vector is None else "REPEAT"
        if layouts[place] is not None:
            tree.links.new(layouts[place], picture.inputs["Vector"])
        tree.links.new(picture.outputs["Color"], target)
