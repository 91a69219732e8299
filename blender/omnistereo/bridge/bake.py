# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Computed materials as pictures: Cycles bakes them, object by object."""
import bpy
import numpy as np

from .looks import output_of, principled_input, source_of
from .pictures import SRGB
from .prepare import MESHES
from .report import step
from .unroll import picture_of

UV = "ods bake"


def _own_mesh(context, each):
    """The object's mesh with its modifiers applied, its own, with a UV map that has no overlaps."""
    depsgraph = context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(each.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                           depsgraph=depsgraph)
    if each.type != "MESH":
        return None
    each.modifiers.clear()
    each.data = mesh
    while len(mesh.uv_layers) >= 8:
        mesh.uv_layers.remove(mesh.uv_layers[-1])
    layer = mesh.uv_layers.new(name=UV, do_init=False)
    mesh.uv_layers.active = layer
    bpy.ops.object.select_all(action="DESELECT")
    each.select_set(True)
    context.view_layer.objects.active = each
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.reveal()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(angle_limit=1.15, island_margin=0.004)
    bpy.ops.object.mode_set(mode="OBJECT")
    return mesh


def _bake_input(context, each, material, node, key, size):
    tree = material.node_tree
    image = bpy.data.images.new(f"{material.name} {key}", size, size, float_buffer=key == "emission",
                                is_data=key not in SRGB or key == "emission")
    target = tree.nodes.new("ShaderNodeTexImage")
    target.image = image
    for other in tree.nodes:
        other.select = False
    target.select = True
    tree.nodes.active = target
    output = output_of(tree)
    if key == "normal":
        bpy.ops.object.bake(type="NORMAL", margin=4, use_clear=True, normal_space="TANGENT")
    else:
        emission = tree.nodes.new("ShaderNodeEmission")
        tree.links.new(source_of(principled_input(node, key)), emission.inputs["Color"])
        tree.links.new(emission.outputs[0], output.inputs["Surface"])
        bpy.ops.object.bake(type="EMIT", margin=4, use_clear=True)
        tree.links.new(node.outputs[0], output.inputs["Surface"])
        tree.nodes.remove(emission)
    if key == "emission":
        target.image = _bright_picture(image, principled_input(node, "strength"))
    else:
        image.pack()
    return target


def _bright_picture(image, strength):
    """The picture of emission as shares of its peak, which becomes the strength."""
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(image.size[1], image.size[0], -1)[..., :3]
    peak = max(float(values.max()), 1.0)
    strength.default_value *= peak
    name = image.name
    bpy.data.images.remove(image)
    return picture_of(values / peak, name, False, peak > 1.0)


def _connect(tree, node, key, target):
    uv = tree.nodes.new("ShaderNodeUVMap")
    uv.uv_map = UV
    tree.links.new(uv.outputs[0], target.inputs["Vector"])
    if key == "normal":
        between = tree.nodes.new("ShaderNodeNormalMap")
        between.uv_map = UV
        tree.links.new(target.outputs["Color"], between.inputs["Color"])
        tree.links.new(between.outputs[0], principled_input(node, key))
        return
    tree.links.new(target.outputs["Color"], principled_input(node, key))


def _prepare_cycles(scene):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.bake_type = "EMIT"
    scene.render.bake.use_selected_to_active = False
    scene.render.bake.target = "IMAGE_TEXTURES"


def bake(context, shown, computed, size):
    """computed: material name -> inputs. Each object gets its own copy of such a material, with pictures.

    Returns the names of those that stay as they are on something that deforms."""
    scene = context.scene
    before = scene.render.engine
    _prepare_cycles(scene)
    left = set()
    users = [o for o in shown if o.type in MESHES
             and any(s.material and s.material.name in computed for s in o.material_slots)]
    for count, each in enumerate(users):
        step(f"baking '{each.name}'", 0.15 + 0.4 * count / len(users))
        deforms = any(m.type == "ARMATURE" for m in each.modifiers) or getattr(each.data, "shape_keys", None)
        mesh = None if deforms or each.type != "MESH" else _own_mesh(context, each)
        if mesh is None:
            left.update(s.material.name for s in each.material_slots if s.material and s.material.name in computed)
            continue
        for slot in each.material_slots:
            if slot.material is None or slot.material.name not in computed:
                continue
            keys = computed[slot.material.name]
            material = slot.material.copy()
            slot.material = material
            tree = material.node_tree
            node = source_of(output_of(tree).inputs["Surface"]).node
            targets = [(key, _bake_input(context, each, material, node, key, size)) for key in keys]
            for key, target in targets:
                _connect(tree, node, key, target)
    scene.render.engine = before
    return left
