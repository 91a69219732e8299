# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Exports a scene for Omnistereo: scene.glb, world.exr if the world is a picture, and bridge.json with all else.

Started by the command as `blender --background ... --python run.py -- SCENE FOLDER [--bake N]`, and by the add-on
through export_scene(). Changes the open scene in memory and saves nothing.
"""
import json
import os

import bpy

from . import bake, camera, lights, materials, means, motion, prepare, world
from .glb import FLOAT, Glb
from .places import local_place, parts
from .report import Failure, Report, say

VERSION = 1  # of bridge.json and of what it goes with


def _repair_numpy():
    """Some versions of Blender call names that newer versions of NumPy lack."""
    import numpy

    for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
        if name not in numpy.__dict__:
            setattr(numpy, name, kind)


# --- opening


def _version_of(path):
    """Of the Blender that saved a file, by its first bytes; (0, 0) if it is packed."""
    with open(path, "rb") as file:
        start = file.read(17)
    # BLENDER-v304, and from 5.0 on BLENDER17-01v0500.
    digits = start[13:17] if start[7:9].isdigit() else start[9:12]
    return divmod(int(digits), 100) if start.startswith(b"BLENDER") and digits.isdigit() else (0, 0)


def _refuse_newer(made):
    own = bpy.app.version
    if tuple(made[:2]) > tuple(own[:2]):
        raise Failure(f"it was saved by Blender {made[0]}.{made[1]}, and this is {own[0]}.{own[1]}: "
                      "give a newer one with --blender PATH")


def _open_blend(path):
    try:
        _refuse_newer(_version_of(path))  # Blender 3.4 crashes when it opens a file of 4.3
        bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=False)
    except (OSError, RuntimeError) as error:
        raise Failure(f"Blender cannot open it: {_one_line(error)}") from None
    _refuse_newer(bpy.data.version)


def _one_line(error):
    """The first line, or of an add-on's traceback the error at its end."""
    lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Location:")]
    if not lines:
        return type(error).__name__
    return lines[-1 if "Traceback" in lines[0] else 0].removeprefix("Error: ").strip()


def _importers(kind):
    """In the order in which they are tried: their names and options."""
    return {
        ".fbx": [("import_scene.fbx", {})],
        ".obj": [("wm.obj_import", {}), ("import_scene.obj", {})],
        ".dae": [("wm.collada_import", {})],
        ".ply": [("wm.ply_import", {}), ("import_mesh.ply", {})],
        ".stl": [("wm.stl_import", {}), ("import_mesh.stl", {})],
        ".abc": [("wm.alembic_import", {"as_background_job": False})],
    }.get(kind, [("wm.usd_import", {})])


def _import(path):
    kind = os.path.splitext(path)[1].lower()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for name, options in _importers(kind):
        group, operator = name.split(".")
        call = getattr(getattr(bpy.ops, group), operator)
        try:
            call.get_rna_type()
        except (KeyError, AttributeError):
            continue
        try:
            result = call(filepath=path, **options)
        except Exception as error:  # an add-on's own errors are of any kind
            raise Failure(f"Blender cannot read it: {_one_line(error)}") from None
        if "FINISHED" not in result or not bpy.data.objects:
            raise Failure("Blender finds nothing in it")
        return
    raise Failure(f"this Blender does not read {kind} files")


# --- exporting


def _deforms(scene):
    """Whether the exporter's own animations are needed: of joints and shape keys; motion.py has all else."""
    return any(o.type == "ARMATURE" or getattr(o.data, "shape_keys", None) for o in scene.objects)


def _options(scene):
    """Of the exporter, those that this version has."""
    wanted = {
        "export_format": "GLB", "use_renderable": True, "use_visible": False, "use_active_scene": True,
        "export_apply": True, "export_yup": True, "export_extras": True, "export_lights": False,
        "export_cameras": False, "export_animations": _deforms(scene), "export_nla_strips": False,
        "export_animation_mode": "ACTIVE_ACTIONS", "export_frame_range": True, "export_force_sampling": True,
        "export_colors": True, "export_texcoords": True, "export_normals": True, "export_tangents": False,
        "export_materials": "EXPORT", "export_image_format": "AUTO", "export_gn_mesh": False,
        "export_hierarchy_flatten_objs": False, "export_shared_accessors": False,
    }
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    return {key: value for key, value in wanted.items() if key in known}


def _run_exporter(path, scene):
    try:
        bpy.ops.export_scene.gltf(filepath=path, **_options(scene))
    except Exception as error:
        raise Failure(f"Blender's glTF exporter failed: {_one_line(error)}") from None
    if not os.path.exists(path):
        raise Failure("Blender's glTF exporter wrote nothing")


def _nodes_by_mark(glb):
    nodes = {}
    for index, node in enumerate(glb.list("nodes")):
        mark = node.get("extras", {}).get(prepare.MARK)
        if mark is not None:
            nodes.setdefault(int(mark), index)
    return nodes


def _materials(report, prepared, context, size, folder):
    computed, strengths, translucent, scales = {}, {}, set(), {}
    shown = [o for o in prepared.objects if not o.hide_render]
    meshes = [o for o in shown if o.type in prepare.MESHES]
    materials.fill_slots(meshes)
    used = {s.material for o in meshes for s in o.material_slots if s.material}
    for material in sorted(used, key=lambda m: m.name):
        if material.library:
            continue
        node = materials.simplify(material, report)
        if node is None:
            continue
        keys = materials.computed_inputs(node)
        if keys:
            computed[material.name] = keys
    if computed and size > 0:
        done, left = bake.bake(context, shown, computed, size, report)
        for name in left:
            report.warn(f"material '{name}' could not be baked on something that deforms")
    elif computed:
        means.use_means(context, shown, computed, folder)
        for name, keys in computed.items():
            report.warn(f"material '{name}': its {', '.join(keys)} "
                        f"{'are' if len(keys) > 1 else 'is'} computed by nodes; --bake 1024 makes pictures of them")
    for material in bpy.data.materials:
        if not material.use_nodes or material.node_tree is None or materials.output_of(material.node_tree) is None:
            continue
        found = materials.source_of(materials.output_of(material.node_tree).inputs["Surface"])
        if found is None or found.node.type != "BSDF_PRINCIPLED":
            continue
        if "ods_own" not in found.node:
            scales[material.name] = materials.albedo_scale(found.node)
        emission = materials.strength_of(found.node)
        if emission is None:
            report.warn(f"material '{material.name}': the strength of its emission is computed by nodes")
        else:
            strengths[material.name] = emission
        if "ods_translucent" in material:
            translucent.add(material.name)
    return strengths, translucent, scales


def _add_instances(glb, prepared, nodes):
    by_object = {each: number for number, each in enumerate(prepared.objects)}
    for group in prepared.instances:
        index = nodes.get(by_object[group.prototype])
        if index is None:
            continue
        matrices = group.matrices
        above = nodes.get(by_object.get(group.parent, -1))
        if above is not None:
            inverse = group.parent.matrix_world.inverted_safe()
            matrices = [inverse @ m for m in matrices]
            for scene in glb.list("scenes"):
                if index in scene.get("nodes", []):
                    scene["nodes"].remove(index)
            glb.json["nodes"][above].setdefault("children", []).append(index)
        triples = [parts(local_place(m)) for m in matrices]
        attributes = {
            "TRANSLATION": glb.add_accessor([t[0] for t in triples], "VEC3", FLOAT),
            "ROTATION": glb.add_accessor([t[1] for t in triples], "VEC4", FLOAT),
            "SCALE": glb.add_accessor([t[2] for t in triples], "VEC3", FLOAT),
        }
        node = glb.json["nodes"][index]
        for key in ("translation", "rotation", "scale", "matrix"):
            node.pop(key, None)
        node.setdefault("extensions", {})["EXT_mesh_gpu_instancing"] = {"attributes": attributes}
        glb.use("EXT_mesh_gpu_instancing")


def _add_unseen(glb, prepared, nodes):
    for mark in prepared.unseen:
        if mark in nodes:
            glb.json["nodes"][nodes[mark]].setdefault("extensions", {})["ODS_unseen"] = {}
            glb.use("ODS_unseen")


def _strip_extras(glb):
    for name in ("nodes", "meshes", "materials", "scenes", "cameras"):
        for each in glb.list(name):
            each.pop("extras", None)


def _add_motion(glb, scene, samples, nodes, lamps, cameras):
    clip = motion.Clip(glb, scene.name, samples.times)
    objects = dict(nodes)
    replaced = {index for each, index in objects.items() if "skin" not in glb.json["nodes"][index]}
    motion.add_objects(clip, glb, objects, samples)
    motion.add_seers(clip, cameras, samples)
    motion.add_seers(clip, {lamp.key: lamp.node for lamp in lamps if lamp.key}, samples)
    motion.add_powers(clip, [lamp for lamp in lamps if lamp.key], samples)
    motion.merge(glb, clip, replaced)


def _reads():
    """The files that the scene is made of: path, size, time in nanoseconds."""
    files = []
    for path in bpy.utils.blend_paths(absolute=True, packed=False, local=False):
        path = os.path.realpath(bpy.path.abspath(path))
        if os.path.isfile(path):
            found = os.stat(path)
            files.append([path, found.st_size, found.st_mtime_ns])
    return files


def export_scene(context, folder, size=0, report=None):
    """Writes the files for the context's scene. size: of the pictures of computed materials; 0: none are made."""
    report = report or Report()
    _repair_numpy()
    scene = context.scene
    if bpy.ops.object.mode_set.poll() and context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    reads = _reads()
    animated = motion.is_animated(scene)
    if animated:
        scene.frame_set(scene.frame_start)
    prepared = prepare.prepare(context, report)
    materials.name_missing_pictures(report)
    report.step("reading materials", 0.15)
    strengths, translucent, scales = _materials(report, prepared, context, size, folder)
    report.step("exporting", 0.55)
    path = os.path.join(folder, "scene.glb")
    _run_exporter(path, scene)
    report.step("adding lights, camera and world", 0.8)
    glb = Glb(path)
    marks = _nodes_by_mark(glb)
    nodes = {prepared.objects[mark]: index for mark, index in marks.items()}
    materials.finish_in_file(glb, strengths, translucent, scales)
    _add_unseen(glb, prepared, marks)
    lights.name_oddities({light for _, _, light, _ in prepared.lights}, report)
    meter = lights.Meter(folder)
    lamps = [lights.add_light(glb, *each, meter, report) for each in prepared.lights]
    lamps = [lamp for lamp in lamps if lamp]
    seers = sorted((o for o in scene.objects if o.type == "CAMERA"), key=lambda o: o != scene.camera)
    cameras = {each: camera.add_node(glb, each, each.matrix_world) for each in seers}
    _add_instances(glb, prepared, marks)
    if animated:
        report.step("following what moves", 0.85)
        samples = motion.sample(context, [*nodes, *cameras, *(l.key for l in lamps if l.key)],
                                [l.key for l in lamps if l.key], report)
        _add_motion(glb, scene, samples, nodes, lamps, cameras)
    else:
        glb.json.pop("animations", None)
    report.step("rendering the world", 0.95)
    environment = world.export_world(glb, scene, folder, report)
    _strip_extras(glb)
    glb.json["asset"]["generator"] = f"Omnistereo's exporter in Blender {bpy.app.version_string}"
    glb.save(path)
    render = scene.render
    result = {
        "omnistereo_bridge": VERSION,
        "blender": ".".join(str(n) for n in bpy.app.version),
        "fps": render.fps / render.fps_base,
        "reads": reads,
        "warnings": report.warnings,
    }
    glows = any(max(color) * strength > 0 for color, strength in strengths.values())
    if lamps or glows or environment != "0,0,0":
        result["environment"] = environment  # else nothing shines, and ods finds some light
    if scene.camera:
        result["camera"] = camera.describe(scene, scene.camera, scene.camera.matrix_world, report)
    with open(os.path.join(folder, "bridge.json"), "w", encoding="utf-8") as file:
        json.dump(result, file)
    return result


def main(arguments):
    """arguments: SCENE FOLDER [--bake N]. The exit code."""
    path, folder = arguments[0], arguments[1]
    size = int(arguments[3]) if len(arguments) > 3 and arguments[2] == "--bake" else 0
    report = Report()
    report.step = lambda what, share: say("step", f"{share:.3f} {what}")
    try:
        _repair_numpy()
        if path.lower().endswith(".blend"):
            _open_blend(path)
        else:
            _import(path)
        export_scene(bpy.context, folder, size, report)
    except Failure as failure:
        say("error", failure)
        return 3
    except MemoryError:
        say("error", "Blender has run out of memory")
        return 3
    say("done", VERSION)
    return 0
