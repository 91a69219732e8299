# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Lamps with the radiometry of Cycles.

Measured in Blender 3.4 (docs/blender.md): a point light or a spot of W watts has W / (4 pi) watts per steradian, an
area light of area A the radiance W / (4 A) on its front, and a sun's strength is the irradiance of a surface that faces
it.
"""
import math
import os

import bpy

from .glb import UNSIGNED_SHORT
from .places import TO_GLTF, columns
from .stage import Stage, pixels

SIDES = 64  # of the polygon that replaces a disc
PLACED = {"NEW_GEOMETRY", "LIGHT_PATH", "CAMERA", "FRESNEL", "LAYER_WEIGHT", "OBJECT_INFO"}


def _mirror():
    """A square across +Y, at 1 m."""
    material = bpy.data.materials.new("ods mirror")
    material.use_nodes = True
    tree = material.node_tree
    glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
    glossy.inputs["Color"].default_value, glossy.inputs["Roughness"].default_value = (1.0, 1.0, 1.0, 1.0), 0.0
    tree.links.new(glossy.outputs[0], next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL").inputs["Surface"])
    mesh = bpy.data.meshes.new("ods mirror")
    mesh.from_pydata([(-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    return bpy.data.objects.new("ods mirror", mesh)


def _measured(light, folder):
    """What the nodes shine at a distance of 1 m, on the axis: of a lamp of radiance 1, which only mirrors show."""
    copy = light.copy()
    copy.type = "AREA"
    copy = bpy.data.lights[copy.name]  # of the new type
    copy.shape, copy.size, copy.energy, copy.color, copy.spread = "SQUARE", 1.0, 4.0, (1.0, 1.0, 1.0), math.pi
    if hasattr(copy, "use_temperature"):
        copy.use_temperature = False
    lamp, mirror = bpy.data.objects.new("ods lamp", copy), _mirror()
    lamp.rotation_euler = (math.pi / 2, 0.0, 0.0)
    stage = Stage()
    stage.scene.cycles.max_bounces = 1
    stage.data.type, stage.data.ortho_scale = "ORTHO", 0.1
    for each in (lamp, mirror):
        stage.scene.collection.objects.link(each)
    path = os.path.join(folder, "lamp.exr")
    stage.render(path, 4, 4, 16)
    found = pixels(path)[..., :3].mean(axis=(0, 1)).tolist()
    os.remove(path)
    stage.remove()
    mesh = mirror.data
    bpy.data.batch_remove([lamp, mirror, copy, mesh.materials[0], mesh])
    return found


class Meter:
    """What the nodes of each light shine, measured once."""

    def __init__(self, folder):
        self.folder, self.found = folder, {}

    def measure(self, light):
        if light.name_full not in self.found:
            self.found[light.name_full] = _measured(light, self.folder)
        return self.found[light.name_full]


def _varies(node):
    """Whether what it says may depend on where the light falls."""
    if node.type == "LIGHT_FALLOFF":
        return any(output.is_linked for output in node.outputs if output.name != "Quadratic")
    return node.type.startswith("TEX_") or node.type in PLACED


def _factor_of(light, meter, ledger):
    """What makes its power besides power_of(), by colour."""
    factor = [1.0] * 3
    if ledger.read(light, "use_temperature", False):
        factor = list(ledger.read(light, "temperature_color", factor))
    if not light.use_nodes or light.node_tree is None:
        return factor
    output = next((n for n in light.node_tree.nodes if n.type == "OUTPUT_LIGHT" and n.is_active_output), None)
    if output is None or not output.inputs["Surface"].is_linked:
        return [0.0] * 3
    if _plain_emission(light) is None:
        if any(_varies(node) for node in light.node_tree.nodes):
            ledger.lose("nodes that vary a light with direction or distance do not come across: it shines as at 1 m in "
                        "front of it", "light", light.name)
        factor = [f * m for f, m in zip(factor, meter.measure(light))]
    return factor


def _plain_emission(light):
    """The node that alone makes its light of constants."""
    if not light.use_nodes or light.node_tree is None:
        return None
    output = next((n for n in light.node_tree.nodes if n.type == "OUTPUT_LIGHT" and n.is_active_output), None)
    node = output.inputs["Surface"].links[0].from_node if output and output.inputs["Surface"].is_linked else None
    return node if node is not None and node.type == "EMISSION" and not any(i.is_linked for i in node.inputs) else None


def power_of(light):
    """Watts by colour, as its settings say now."""
    if not hasattr(light, "energy"):
        return [0.0] * 3
    watts = light.energy * 2.0 ** getattr(light, "exposure", 0.0)
    node = _plain_emission(light)
    if node is not None:
        watts *= node.inputs["Strength"].default_value
        return [watts * c * e for c, e in zip(light.color, node.inputs["Color"].default_value)]
    return [watts * c for c in light.color]


def shape_of(light):
    """Whatever makes its shape, for comparison."""
    names = ("size", "size_y", "angle", "shadow_soft_size", "spot_size", "spot_blend")
    return [getattr(light, name, 0.0) for name in names]


def area_of(light, matrix):
    width = light.size
    height = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size
    across = matrix.to_3x3().col[0].length * width
    along = matrix.to_3x3().col[1].length * height
    round_share = math.pi / 4 if light.shape in ("DISK", "ELLIPSE") else 1.0
    return width, height, across * along * round_share


def corners_of(light):
    """Of the lamp in its own plane, anticlockwise as seen from where it shines, with the area that it has."""
    width = light.size
    height = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size
    if light.shape not in ("DISK", "ELLIPSE"):
        return [(-width / 2, -height / 2), (-width / 2, height / 2), (width / 2, height / 2), (width / 2, -height / 2)]
    wider = math.sqrt(2 * math.pi / (SIDES * math.sin(2 * math.pi / SIDES)))
    turns = [-2 * math.pi * i / SIDES for i in range(SIDES)]
    return [(wider * width / 2 * math.cos(t), wider * height / 2 * math.sin(t)) for t in turns]


def strength_of(kind, light, matrix):
    """What one watt, or one W/m2 of a sun, becomes in the file."""
    if kind == "AREA":
        area = area_of(light, matrix)[2]
        return 1.0 / (4.0 * area) if area > 0 else 0.0
    return 1.0 if kind == "SUN" else 1.0 / (4.0 * math.pi)


def _add_area(glb, name, light, radiance):
    brightest = max(max(radiance), 1e-30)
    material = glb.append("materials", {
        "name": name,
        "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0, "roughnessFactor": 1},
        "emissiveFactor": [c / brightest for c in radiance],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": brightest}},
    })
    glb.use("KHR_materials_emissive_strength")
    glb.use("ODS_unseen")
    corners = corners_of(light)
    triangles = [(0, i, i + 1) for i in range(1, len(corners) - 1)]
    mesh = glb.append("meshes", {"name": name, "primitives": [{
        "attributes": {
            "POSITION": glb.add_accessor([(x, y, 0.0) for x, y in corners], "VEC3"),
            "NORMAL": glb.add_accessor([(0.0, 0.0, -1.0)] * len(corners), "VEC3"),
        },
        "indices": glb.add_accessor(triangles, "SCALAR", UNSIGNED_SHORT),
        "material": material,
    }]})
    return material, {"name": name, "mesh": mesh, "extensions": {"ODS_unseen": {"onlyLight": True}}}


def _add_punctual(glb, name, light, intensity):
    brightest = max(max(intensity), 1e-30)
    lamp = {"name": name, "color": [c / brightest for c in intensity], "intensity": brightest}
    shape = {}
    if light.type == "SUN":
        lamp["type"] = "directional"
        shape["angle"] = min(light.angle, math.pi / 2)
    else:
        lamp["type"] = "spot" if light.type == "SPOT" else "point"
        shape["radius"] = light.shadow_soft_size
    if light.type == "SPOT":
        outer = min(light.spot_size / 2, math.pi / 2 * 0.999)
        # The blend is a share of the difference between the cosines of the cone's edge and its axis.
        inner = math.acos(min(1.0, math.cos(outer) + (1 - math.cos(outer)) * light.spot_blend))
        lamp["spot"] = {"innerConeAngle": max(0.0, min(inner, outer * 0.999)), "outerConeAngle": outer}
        shape["cone"] = "smooth cosine" if bpy.app.version < (3, 5, 0) else "smooth"
    lamp["extensions"] = {"ODS_light_shape": shape}
    glb.use("KHR_lights_punctual")
    glb.use("ODS_light_shape")
    lamps = glb.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
    lamps.append(lamp)
    return len(lamps) - 1, {"name": name, "extensions": {"KHR_lights_punctual": {"light": len(lamps) - 1}}}


class Lamp:
    """A light in the file: its node, what a watt of each colour is there, and the material or the light that has it."""

    def __init__(self, key, node, factor, material=None, light=None):
        self.key, self.node, self.factor, self.material, self.light = key, node, factor, material, light


READ = ("type", "energy", "color", "size", "size_y", "shape", "angle", "shadow_soft_size", "spot_size", "spot_blend",
        "use_temperature", "temperature", "normalize", "exposure")


def add_light(glb, key, name, light, matrix, meter, samples, ledger):
    """A light datablock at a place; None: it never shines."""
    # A portal leads the renderer's rays and shines nothing.
    if ledger.read(light, "cycles.is_portal", False):
        return None
    frames = samples.powers.get(key, []) if samples else []
    if not any(max(power) > 0.0 for power in [power_of(light), *frames]):
        return None
    scale = strength_of(light.type, light, matrix)
    factor = [scale * f for f in _factor_of(light, meter, ledger)]
    power = [f * p for f, p in zip(factor, power_of(light))]
    if light.type == "AREA":
        material, node = _add_area(glb, name, light, power)
        place = {"material": material}
    else:
        index, node = _add_punctual(glb, name, light, power)
        place = {"light": index}
    node["matrix"] = columns(TO_GLTF @ matrix)
    return Lamp(key, glb.add_root(node), factor, **place)


def close(lights, ledger):
    """Names what is set on the lights and was not read."""
    lights = [light for light in lights if not getattr(light.cycles, "is_portal", False)]
    for light in lights:
        ledger.tick(light, *READ)
        if hasattr(light.cycles, "cast_shadow"):
            ledger.tick(light, "use_shadow")  # of another renderer, before Blender 4.2
    ledger.close("light", lights)
