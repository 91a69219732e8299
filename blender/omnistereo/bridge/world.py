# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""The world as a lat-long picture, as Cycles sees it. Its middle looks along Blender's +Y, which is glTF's -Z."""
import math
import os

import numpy as np
from mathutils import Vector

from .camera import panorama_of
from .groups import unpack_groups
from .motion import moves
from .places import TO_GLTF, columns
from .stage import Stage, pixels

LARGEST = 4096
USUAL = 1024
SKY = 512  # as wide as Cycles' own table of a sky
SUN_PIXELS = 64


def _background(world):
    """The Background node, if it alone makes the world."""
    output = next((n for n in world.node_tree.nodes if n.type == "OUTPUT_WORLD" and n.is_active_output), None)
    if output is None or not output.inputs["Surface"].is_linked:
        return None
    node = output.inputs["Surface"].links[0].from_node
    return node if node.type == "BACKGROUND" else None


def even_color(world):
    """The colour of a world that is the same in all directions; None: it is not."""
    if world is None:
        return [0.0] * 3
    if not world.use_nodes or world.node_tree is None:
        return [float(c) for c in world.color]
    output = next((n for n in world.node_tree.nodes if n.type == "OUTPUT_WORLD" and n.is_active_output), None)
    if output is None or not output.inputs["Surface"].is_linked:
        return [0.0] * 3
    node = _background(world)
    if node is None or any(i.is_linked for i in node.inputs):
        return None
    strength = node.inputs["Strength"].default_value
    return [max(0.0, c * strength) for c in list(node.inputs["Color"].default_value)[:3]]


def _width_of(nodes):
    widths = [n.image.size[0] for n in nodes if n.type == "TEX_ENVIRONMENT" and n.image and n.image.size[0] > 0]
    is_sky = {n.type for n in nodes} == {"TEX_SKY", "BACKGROUND", "OUTPUT_WORLD"}
    return min(max(widths), LARGEST) if widths else SKY if is_sky else USUAL


def _sun_direction(node):
    """Towards the sun of a Nishita sky, in Blender's space; mapped skies keep theirs only unturned."""
    elevation, turn = node.sun_elevation, node.sun_rotation
    return Vector((math.cos(elevation) * math.sin(turn), math.cos(elevation) * math.cos(turn), math.sin(elevation)))


def _measure_sun(stage, node, folder):
    """The irradiance that the sun's disc brings to a surface that faces it: with the disc less without it."""
    towards = _sun_direction(node)
    half = math.tan(0.75 * node.sun_size)
    stage.camera.rotation_euler = towards.to_track_quat("-Z", "Y").to_euler()
    stage.data.type = "PERSP"
    stage.data.sensor_fit = "HORIZONTAL"
    stage.data.angle = 2 * math.atan(half)
    pictures = []
    for disc in (True, False):
        node.sun_disc = disc
        path = os.path.join(folder, "sun.exr")
        stage.render(path, SUN_PIXELS, SUN_PIXELS, 16)
        pictures.append(pixels(path)[..., :3])
        os.remove(path)
    node.sun_disc = True
    at = (np.arange(SUN_PIXELS) + 0.5) / SUN_PIXELS * 2 - 1
    x, y = np.meshgrid(at * half, at * half)
    # A pixel's solid angle times the cosine to the axis: dA cos^4.
    weight = (2 * half / SUN_PIXELS) ** 2 / (1 + x * x + y * y) ** 2
    return ((pictures[0] - pictures[1]) * weight[..., None]).sum(axis=(0, 1)).tolist()


def _add_sun(glb, node, irradiance):
    brightest = max(irradiance)
    if not brightest > 0:
        return
    lamps = glb.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
    glb.use("KHR_lights_punctual")
    glb.use("ODS_light_shape")
    lamps.append({
        "name": "sun of the sky", "type": "directional", "intensity": brightest,
        "color": [max(0.0, c / brightest) for c in irradiance],
        "extensions": {"ODS_light_shape": {"angle": node.sun_size}},
    })
    turn = _sun_direction(node).to_track_quat("Z", "Y").to_matrix().to_4x4()
    glb.add_root({
        "name": "sun of the sky", "matrix": columns(TO_GLTF @ turn),
        "extensions": {"KHR_lights_punctual": {"light": len(lamps) - 1}},
    })


def _see(world, is_camera):
    """Sets what Light Path nodes say to a ray of the camera, or to one of light, and returns how to undo that."""
    tree, before = world.node_tree, []
    rays = {"Is Camera Ray"} if is_camera else {"Is Diffuse Ray", "Is Reflection Ray"}
    for node in [n for n in tree.nodes if n.type == "LIGHT_PATH"]:
        for output in node.outputs:
            value = 1.0 if output.name in rays else 0.0
            for link in list(output.links):
                before.append((output, link.to_socket))
                tree.links.remove(link)
                constant = tree.nodes.new("ShaderNodeValue")
                constant.outputs[0].default_value = value
                tree.links.new(constant.outputs[0], before[-1][1])
    return lambda: [tree.links.new(*each) for each in before]


def _render(world, width, samples, path):
    """One colour, if that is all there is; else None, and the picture is written."""
    stage = Stage(world)
    stage.camera.rotation_euler = (math.pi / 2, 0, 0)
    stage.data.type = "PANO"
    pano = panorama_of(stage.data)
    pano.panorama_type = "EQUIRECTANGULAR"
    pano.longitude_min, pano.longitude_max = -math.pi, math.pi
    pano.latitude_min, pano.latitude_max = -math.pi / 2, math.pi / 2
    stage.render(path, width, width // 2, samples)
    stage.remove()
    found = pixels(path)[..., :3]
    if found.min(axis=(0, 1)).tolist() != found.max(axis=(0, 1)).tolist():
        return None
    os.remove(path)
    return found[0, 0].tolist()


def _add_suns(glb, world, nodes, folder, ledger):
    """The discs of skies become lights."""
    skies = [n for n in nodes if n.type == "TEX_SKY" and hasattr(n, "sun_disc") and n.sun_disc
             and n.sky_type not in ("PREETHAM", "HOSEK_WILKIE")]
    for node in skies:
        if node.inputs and node.inputs[0].is_linked:
            ledger.lose("the sun of a turned sky is part of its picture, with soft shadows", "world", world.name)
            continue
        stage = Stage(world)
        _add_sun(glb, node, _measure_sun(stage, node, folder))
        stage.remove()
        node.sun_disc = False


def _surroundings(world, nodes, folder, name, is_camera):
    """What --env and --background take: numbers, or the name of a picture in the folder."""
    undo = _see(world, is_camera)
    kinds = {n.type for n in nodes}
    samples = 1 if kinds & {"TEX_ENVIRONMENT", "TEX_SKY"} else 4  # those are pictures themselves
    color = even_color(world) or _render(world, _width_of(nodes), samples, os.path.join(folder, name))
    undo()
    return name if color is None else _numbers(color)


def _numbers(color):
    return ",".join(f"{c:.9g}" for c in color)


def export_world(glb, scene, folder, ledger):
    """(light, background): what --env takes, and what --background takes; None if that is the same."""
    world = scene.world
    if world is None:
        return "0,0,0", None
    if not world.use_nodes or world.node_tree is None:
        return _numbers(even_color(world)), None
    output = next((n for n in world.node_tree.nodes if n.type == "OUTPUT_WORLD" and n.is_active_output), None)
    if output is not None and output.inputs["Volume"].is_linked:
        ledger.lose("the volume does not come across", "world", world.name, "choose --renderer cycles")
    unpack_groups(world.node_tree)
    nodes = list(world.node_tree.nodes)
    if even_color(world) is None:
        _add_suns(glb, world, nodes, folder, ledger)
    if moves(world):
        ledger.lose("a world that changes stays as in the saved frame", "world", world.name)
    seen = ledger.read(world, "cycles_visibility.camera", True)
    ledger.tick(world, "color")
    ledger.close("world", [world])
    for ray in ("diffuse", "glossy", "transmission", "camera"):
        if hasattr(world, "cycles_visibility"):
            setattr(world.cycles_visibility, ray, True)
    light = _surroundings(world, nodes, folder, "world.exr", False)
    if not seen:
        return light, "0,0,0"
    if not any(n.type == "LIGHT_PATH" for n in nodes):
        return light, None
    background = _surroundings(world, nodes, folder, "background.exr", True)
    return light, background
