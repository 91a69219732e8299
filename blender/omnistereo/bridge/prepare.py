# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the open scene ready for Blender's glTF exporter: what the render shows, as the render shows it.

Changes the scene in memory; nothing is saved.
"""
import bpy

from .report import some

MESHES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
MARK = "ods_number"  # of an object in the file


class Instances:
    """Copies of one mesh that something scatters."""

    def __init__(self, prototype, parent):
        self.prototype, self.parent, self.matrices = prototype, parent, []


def _rendered(view_layer):
    """The objects that the view layer renders, and those that the camera does not see."""
    shown, unseen, held_out = {}, set(), set()

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
        try:
            layer.collection.hide_viewport = False
        except AttributeError:
            pass  # of a library
        for child in layer.children:
            visit(child)

    visit(view_layer.layer_collection)
    for each in shown.values():
        try:
            each.hide_viewport = False
            each.hide_set(False, view_layer=view_layer)
        except (AttributeError, RuntimeError):
            pass


def _modify_as_rendered(scene):
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


def _name_lost(shown, report):
    hair = []
    for each in shown.values():
        strands = [s for s in each.particle_systems if s.settings.type == "HAIR" and s.settings.render_type == "PATH"]
        if strands or each.type == "CURVES":
            hair.append(each.name)
    if hair:
        report.warn(f"hair of {some(hair)} does not come across; to render it in Blender itself: ods rig (docs/slits.md)")
    for kind, what in (("VOLUME", "volumes"), ("GPENCIL", "grease pencil"), ("GREASEPENCIL", "grease pencil"),
                       ("POINTCLOUD", "point clouds")):
        names = [o.name for o in shown.values() if o.type == kind]
        if names:
            report.warn(f"{what} do not come across: {some(names)}")
    smoke = [o.name for o in shown.values()
             if any(m.type == "FLUID" and m.fluid_type == "DOMAIN" and m.domain_settings
                    and m.domain_settings.domain_type == "GAS" for m in o.modifiers)]
    if smoke:
        report.warn(f"smoke and fire do not come across: {some(smoke)}")


def _name_visibility(shown, report):
    odd = [o.name for o in shown.values() if o.type in MESHES
           and not all(getattr(o, f"visible_{ray}", True) for ray in ("diffuse", "glossy", "transmission", "shadow"))]
    if odd:
        report.warn(f"{some(odd)}: hidden from some rays in Cycles, here only the camera can be kept from seeing")
    catchers = [o.name for o in shown.values() if o.type in MESHES and getattr(o, "is_shadow_catcher", False)]
    if catchers:
        words = " ".join(f"--shadow-catcher '{name}'" for name in catchers[:4])
        report.warn(f"{some(catchers)}: a shadow catcher in Blender, an ordinary object here; add --transparent {words}")


class Prepared:
    def __init__(self):
        self.objects = []  # by their mark
        self.unseen = set()  # marks of what the camera does not see
        self.instances = []  # Instances, with a prototype's mark
        self.lights = []  # (key, name, datablock, matrix), key: the light's object, None: a copy


def _mesh_of(source, depsgraph):
    """What is scattered. Geometry nodes scatter meshes that are no object's; they are found at their scatterer."""
    if source.type == "MESH":
        return source.data.copy()
    return bpy.data.meshes.new_from_object(source, preserve_all_data_layers=True, depsgraph=depsgraph)


def _collect_instances(depsgraph, shown, prepared, report):
    groups, meshes, strange = {}, {}, set()
    for each in depsgraph.object_instances:
        if not each.is_instance:
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
    if strange:
        report.warn(f"scattered {some(sorted(strange))} do not come across")
    return list(groups.values())


def _stop_scattering(groups, depsgraph):
    """What we scatter ourselves the exporter must not scatter again. Called when no instance is read any more."""
    for parent in {group.parent for group in groups}:
        for system in parent.particle_systems:
            system.settings.render_type = "NONE"
        if parent.type == "MESH" and any(m.type == "NODES" for m in parent.modifiers) and not parent.library:
            mesh = bpy.data.meshes.new_from_object(parent.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                                   depsgraph=depsgraph)
            parent.modifiers.clear()
            parent.data = mesh


def prepare(context, report):
    scene, view_layer = context.scene, context.view_layer
    prepared = Prepared()
    shown, unseen, held_out = _rendered(view_layer)
    if held_out:
        report.warn(f"{some(sorted(held_out))}: a holdout in Blender, an ordinary object here")
    _modify_as_rendered(scene)
    _unhide(view_layer, shown)
    _name_lost(shown, report)
    _name_visibility(shown, report)
    depsgraph = context.evaluated_depsgraph_get()
    depsgraph.update()
    themselves = {i.object.original.name_full for i in depsgraph.object_instances if not i.is_instance and i.show_self}
    prepared.instances = _collect_instances(depsgraph, shown, prepared, report)
    for each in scene.objects:
        renders = each.name_full in shown and (each.name_full in themselves or each.type not in MESHES)
        if each.type == "LIGHT" and renders:
            prepared.lights.append((each, each.name, each.data, each.matrix_world.copy()))
        if each.type in ("LIGHT", "CAMERA"):
            continue
        try:
            each.hide_render = not renders and each.type in MESHES
            if each.instance_type != "NONE":
                each.instance_type = "NONE"
        except (AttributeError, TypeError):
            pass  # of a library
    strange = sorted({light.name for _, _, light, _ in prepared.lights if not hasattr(light, "energy")})
    prepared.lights = [each for each in prepared.lights if hasattr(each[2], "energy")]
    if strange:  # Blender 2 wrote its hemispheric light, which is gone, into Collada
        report.warn(f"{some(strange)}: lights of a kind that Blender does not have do not come across")
    _stop_scattering(prepared.instances, depsgraph)
    for group in prepared.instances:
        scene.collection.objects.link(group.prototype)
    for number, each in enumerate(scene.objects):
        prepared.objects.append(each)
        each[MARK] = number
        if each.name_full in unseen or "ods_unseen" in each or not getattr(each, "visible_camera", True):
            prepared.unseen.add(number)
    return prepared
