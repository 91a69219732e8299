# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the open scene ready for Blender's glTF exporter: what the render shows, as the render shows it.

Changes the scene in memory; nothing is saved.
"""
import bpy
import numpy as np

MESHES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
MARK = "ods_number"  # of an object in the file


class Instances:
    """Copies of one mesh that something scatters."""

    def __init__(self, prototype, parent):
        self.prototype, self.parent, self.matrices = prototype, parent, []


def _rendered(view_layer, samples):
    """The objects that the view layer renders in some frame, and those that the camera does not see."""
    shown, unseen, held_out = {}, set(), set()
    if samples:
        for each, frames in samples.shown.items():
            each.hide_render = not any(frames)

    def visit(layer, indirect, holdout, hidden):
        hidden = hidden or layer.collection.hide_render
        indirect, holdout = indirect or layer.indirect_only, holdout or layer.holdout
        if not layer.exclude and not hidden:
            for each in layer.collection.objects:
                if each.hide_render:
                    continue
                shown[each.name_full] = each
                if indirect:
                    unseen.add(each.name_full)
                if holdout or getattr(each, "is_holdout", False):
                    held_out.add(each.name_full)
        for child in layer.children:
            visit(child, indirect, holdout, hidden)

    visit(view_layer.layer_collection, False, False, False)
    return shown, unseen, held_out


def _unhide(view_layer, shown):
    def visit(layer):
        layer.hide_viewport = False
        layer.collection.hide_viewport = False
        for child in layer.children:
            visit(child)

    visit(view_layer.layer_collection)
    for each in shown.values():
        each.hide_viewport = False
        each.hide_set(False, view_layer=view_layer)


def modify_as_rendered(scene):
    """The exporter evaluates the scene as viewports do."""
    if scene.render.use_simplify:
        scene.render.simplify_subdivision = scene.render.simplify_subdivision_render
        scene.render.simplify_child_particles = scene.render.simplify_child_particles_render
    for each in scene.objects:
        each.show_instancer_for_viewport = each.show_instancer_for_render
        for modifier in each.modifiers:
            modifier.show_viewport = modifier.show_render
            if modifier.type in ("SUBSURF", "MULTIRES"):
                modifier.levels = modifier.render_levels
    for settings in bpy.data.particles:
        settings.display_percentage = 100
        setattr(settings, "child_percent" if bpy.app.version >= (4, 0, 0) else "child_nbr", settings.rendered_child_count)


def _name_lost(shown, ledger):
    cycles = "choose --renderer cycles"
    kinds = {"VOLUME": "a volume", "GPENCIL": "grease pencil", "GREASEPENCIL": "grease pencil", "CURVES": "hair",
             "POINTCLOUD": "a point cloud"}
    for each in shown.values():
        strands = [s for s in each.particle_systems if s.settings.type == "HAIR" and s.settings.render_type == "PATH"]
        smoke = [m for m in each.modifiers if m.type == "FLUID" and m.fluid_type == "DOMAIN" and m.domain_settings
                 and m.domain_settings.domain_type == "GAS"]
        what = "hair" if strands else "smoke or fire" if smoke else kinds.get(each.type)
        if what:
            ledger.lose(f"{what} does not come across", "object", each.name, cycles)
        if each.type in MESHES and ledger.read(each, "is_shadow_catcher", False):
            ledger.lose("a shadow catcher is an ordinary object here", "object", each.name,
                        f"add --transparent --shadow-catcher '{each.name}'")
        ledger.tick(each, "visible_camera", "hide_render")
    ledger.close("object", [each for each in shown.values() if each.type in MESHES])


class Prepared:
    def __init__(self):
        self.objects = []  # by their mark
        self.unseen = set()  # marks of objects that the camera does not see
        self.instances = []  # Instances, with a prototype's mark
        self.scattered = []  # (prototype, copies) of particles that fly
        self.lights = []  # (key, name, datablock, matrix), key: the light's object, None: a copy


def _mesh_of(source, depsgraph):
    """What is scattered. Geometry nodes scatter meshes that are no object's; they are found at their scatterer."""
    if source.type == "MESH":
        return source.data.copy()
    return bpy.data.meshes.new_from_object(source, preserve_all_data_layers=True, depsgraph=depsgraph)


def _collect_scattered(depsgraph, shown, prepared, samples):
    """What particles carry while they fly."""
    for (source, parent), copies in samples.scattered.items():
        if source.type in MESHES and parent.name_full in shown and not source.hide_render:
            mesh = _mesh_of(source.evaluated_get(depsgraph), depsgraph)
            prepared.scattered.append((bpy.data.objects.new(source.name, mesh), copies))


def _collect_instances(depsgraph, shown, prepared, samples, ledger):
    groups, meshes, strange = {}, {}, set()
    for each in depsgraph.object_instances:
        if not each.is_instance or (samples and each.particle_system):
            continue
        source, parent = each.object, each.parent.original if each.parent else None
        if source.original.hide_render or parent is None or parent.name_full not in shown:
            continue
        matrix = each.matrix_world.copy()
        if source.type == "LIGHT":
            prepared.lights.append((None, source.name, source.original.data, matrix))
            continue
        if source.type not in MESHES:
            if source.type not in ("EMPTY", "CAMERA", "ARMATURE", "LATTICE", "LIGHT_PROBE", "SPEAKER"):
                strange.add(source.name)
            continue
        data = source.data.as_pointer()
        if data not in meshes:
            meshes[data] = _mesh_of(source, depsgraph)
        key = (data, parent.name_full)
        if key not in groups:
            prototype = bpy.data.objects.new(source.original.name, meshes[data])
            groups[key] = Instances(prototype, parent)
            if not getattr(source, "visible_camera", True):
                prototype["ods_unseen"] = 1
        groups[key].matrices.append(matrix)
    for name in sorted(strange):
        ledger.lose("what is scattered does not come across", "object", name)
    return list(groups.values())


def _stop_scattering(parents, depsgraph):
    """What we scatter ourselves the exporter must not scatter again. Called when no instance is read any more."""
    for parent in parents:
        for system in parent.particle_systems:
            system.settings.render_type = "NONE"
        if parent.type == "MESH" and any(m.type == "NODES" for m in parent.modifiers):
            mesh = bpy.data.meshes.new_from_object(parent.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                                   depsgraph=depsgraph)
            parent.modifiers.clear()
            parent.data = mesh


def _take_materials_of_nodes(shown, depsgraph):
    """Geometry nodes may give a mesh other materials than its object's slots, by which the exporter goes."""
    for each in shown:
        kinds = {m.type for m in each.modifiers if m.show_viewport}
        if each.type != "MESH" or "NODES" not in kinds or "ARMATURE" in kinds:
            continue
        evaluated = each.evaluated_get(depsgraph)
        made = [m and m.name_full for m in evaluated.data.materials]
        if made == [s.material and s.material.name_full for s in each.material_slots]:
            continue
        mesh = bpy.data.meshes.new_from_object(evaluated, preserve_all_data_layers=True, depsgraph=depsgraph)
        each.shape_key_clear()
        each.modifiers.clear()
        each.data = mesh
        for slot in each.material_slots:
            slot.link = "DATA"


def number_points(context, objects):
    """Objects that deform get the mesh that they are now. Its last UV map numbers the points (motion.add_points())."""
    depsgraph = context.evaluated_depsgraph_get()
    for each in objects:
        mesh = bpy.data.meshes.new_from_object(each.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                               depsgraph=depsgraph)
        if each.type != "MESH":
            continue
        each.shape_key_clear()
        each.modifiers.clear()
        each.data = mesh
        while len(mesh.uv_layers) >= 8:
            mesh.uv_layers.remove(mesh.uv_layers[-1])
        layer = mesh.uv_layers.new(name="ods points", do_init=False)
        numbers = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", numbers)
        layer.data.foreach_set("uv", np.stack([numbers % 4096, numbers // 4096], 1).astype(np.float32).ravel())


def prepare(context, samples, ledger):
    """samples: of what moves; None: nothing does."""
    scene, view_layer = context.scene, context.view_layer
    prepared = Prepared()
    shown, unseen, held_out = _rendered(view_layer, samples)
    for name in sorted(held_out):
        ledger.lose("a holdout is an ordinary object here", "object", name)
        ledger.tick(shown[name], "is_holdout")
    _unhide(view_layer, shown)
    _name_lost(shown, ledger)
    depsgraph = context.evaluated_depsgraph_get()
    depsgraph.update()
    themselves = {i.object.original.name_full for i in depsgraph.object_instances if not i.is_instance and i.show_self}
    prepared.instances = _collect_instances(depsgraph, shown, prepared, samples, ledger)
    if samples:
        _collect_scattered(depsgraph, shown, prepared, samples)
    for each in scene.objects:
        renders = each.name_full in shown and (each.name_full in themselves or each.type not in MESHES)
        if each.type == "LIGHT" and renders:
            prepared.lights.append((each, each.name, each.data, each.matrix_world.copy()))
        if each.type in ("LIGHT", "CAMERA"):
            continue
        each.hide_render = not renders and each.type in MESHES
        if each.instance_type != "NONE":
            each.instance_type = "NONE"
    for _, _, light, _ in prepared.lights:
        if not hasattr(light, "energy"):  # Blender 2 wrote its hemispheric light, which is gone, into Collada
            ledger.lose("a light of a kind that Blender does not have does not come across", "light", light.name)
    prepared.lights = [each for each in prepared.lights if hasattr(each[2], "energy")]
    parents = {group.parent for group in prepared.instances}
    _stop_scattering(parents | {parent for _, parent in (samples.scattered if samples else ())}, depsgraph)
    _take_materials_of_nodes([each for each in shown.values() if each not in parents], depsgraph)
    for prototype in [*(group.prototype for group in prepared.instances), *(each for each, _ in prepared.scattered)]:
        scene.collection.objects.link(prototype)
    for number, each in enumerate(scene.objects):
        prepared.objects.append(each)
        each[MARK] = number
        if each.name_full in unseen or "ods_unseen" in each or not getattr(each, "visible_camera", True):
            prepared.unseen.add(number)
    return prepared
