# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Computed inputs as one mean each: what a surface looks like where no picture of it is baked."""
import os

import bpy
from mathutils import Vector

from . import materials
from .looks import output_of, principled_input, source_of
from .pictures import BAKED, FLAT
from .prepare import MESHES
from .stage import Stage, pixels

SIZE = 32
FROM = Vector((0.5, -0.7, 0.5)).normalized()  # no usual surface is parallel to it


def _glowing(material, key):
    """A copy that shines with what an input computes."""
    copy = material.copy()
    tree = copy.node_tree
    output = output_of(tree)
    node = source_of(output.inputs["Surface"]).node
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(source_of(principled_input(node, key)), emission.inputs["Color"])
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return copy


def _frame(stage, each):
    corners = [each.matrix_world @ Vector(corner) for corner in each.bound_box]
    middle = sum(corners, Vector()) / len(corners)
    radius = max((corner - middle).length for corner in corners) or 1.0
    stage.data.type = "ORTHO"
    stage.data.ortho_scale = 2 * radius
    stage.data.clip_start, stage.data.clip_end = radius * 0.01, radius * 10
    stage.camera.location = middle + FROM * radius * 3
    stage.camera.rotation_euler = FROM.to_track_quat("Z", "Y").to_euler()


def _mean(context, each, material, key, folder):
    """None: nothing of it can be seen."""
    path = os.path.join(folder, "mean.exr")
    stage, copy = Stage(), _glowing(material, key)
    stage.scene.collection.objects.link(each)
    stage.scene.view_layers[0].material_override = copy
    _frame(stage, each)
    stage.render(path, SIZE, SIZE, 1)
    found = pixels(path).sum(axis=(0, 1))
    os.remove(path)
    stage.remove()
    bpy.data.materials.remove(copy)
    return [float(c / found[3]) for c in found[:3]] if found[3] > 0 else None


def use_means(context, shown, computed, folder):
    """computed: material name -> inputs. All but normals become constants."""
    users = {}
    for each in shown:
        for slot in each.material_slots if each.type in MESHES else []:
            if slot.material is not None:
                users.setdefault(slot.material.name, each)
    for name, keys in computed.items():
        material = bpy.data.materials[name]
        node = source_of(output_of(material.node_tree).inputs["Surface"]).node
        for key in (key for key in (*BAKED, *FLAT) if key in keys and key != "normal"):
            mean = _mean(context, users[name], material, key, folder)
            if mean is None:
                continue
            socket = principled_input(node, key)
            materials.unlink(node, key)
            most = 1.0 if key in BAKED else 100.0
            socket.default_value = (*mean, 1.0) if key in ("color", "emission") else min(max(sum(mean) / 3, 0.0), most)
