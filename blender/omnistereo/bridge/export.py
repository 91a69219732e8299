# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Exports a scene for Omnistereo: scene.glb, world.exr if the world is a picture, and bridge.json with all else.

Started by the command as `blender --background ... --python run.py -- SCENE FOLDER [--bake N] [--scene NAME]
[--beginning FRAMES [--first N --last N]]`.
Changes the open scene in memory and saves nothing.
"""
import json
import os

import bpy

from . import bake, beginning, camera, library, lights, materials, means, motion, opening, pictures, prepare, unroll, world
from .glb import FLOAT, Glb
from .ledger import Ledger, some
from .places import local_place, parts
from .report import Failure, say, step

VERSION = 1  # of bridge.json and the files beside it


def _deforms(scene):
    """Whether the exporter's own animations are needed: of joints and shape keys; motion.py has all else."""
    return any(o.type == "ARMATURE" or getattr(o.data, "shape_keys", None) for o in scene.objects)


def _options(scene):
    """Of the exporter, those that this version has."""
    wanted = {
        "export_format": "GLB", "use_renderable": True, "use_visible": False, "use_active_scene": True,
        "export_apply": True, "export_yup": True, "export_extras": True, "export_current_frame": True,
        "export_lights": False, "export_cameras": False, "export_animations": _deforms(scene),
        "export_nla_strips": False, "export_animation_mode": "ACTIVE_ACTIONS", "export_frame_range": True,
        "export_force_sampling": True,
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
        raise Failure(f"Blender's glTF exporter failed: {opening.one_line(error)}") from None
    if not os.path.exists(path):
        raise Failure("Blender's glTF exporter wrote nothing")


def _nodes_by_mark(glb):
    nodes = {}
    for index, node in enumerate(glb.list("nodes")):
        mark = node.get("extras", {}).get(prepare.MARK)
        if mark is not None:
            nodes.setdefault(int(mark), index)
    return nodes


def _constants(material, node, found, rules, ledger):
    """The inputs that become constants in any case: what is the same all over, and what glTF has no pictures for."""
    same = {key for key in found if unroll.is_constant_everywhere(materials.principled_input(node, key))}
    if found.get("normal") == pictures.MISSING:
        materials.unlink(node, "normal")
        same.add("normal")
    for key in pictures.FLAT:
        socket = materials.principled_input(node, key)
        fault = rules.fault(key, socket) if socket is not None else None
        if fault is None and (key != "ior" or materials.source_of(socket) is None):
            continue
        same.add(key)
        if not unroll.is_constant_everywhere(socket):
            ledger.lose(f"a mean of what nodes compute ({socket.name})", "material", material.name)
    return same


def _materials(context, prepared, samples, size, folder, ledger):
    """Leaves materials that the exporter understands. By their names: emission, which are translucent, albedo_scale(),
    which read vertex colours."""
    shown = [o for o in prepared.objects if not o.hide_render]
    meshes = [o for o in shown if o.type in prepare.MESHES]
    materials.fill_slots(meshes, ledger.read(context.view_layer, "material_override"))
    users, computed, constant, causes, rules = {}, {}, {}, {}, pictures.Rules(ledger)
    for each in meshes:
        for material in {s.material for s in each.material_slots}:
            users.setdefault(material, []).append(each)
    for material in sorted(users, key=lambda m: m.name):
        node = materials.simplify(material, ledger)
        if node is None:
            continue
        found = pictures.computed_inputs(node, rules)
        if found and (pictures.changes(node) or (samples and material.name in samples.looks)):
            ledger.lose("values computed for each frame are frozen at the saved frame", "material", material.name)
        same = constant[material.name] = _constants(material, node, found, rules, ledger)
        vary = {key: fault for key, fault in found.items() if key not in same}
        unroll.unroll(material, node, vary, users[material], rules, folder)
        found = {key: fault for key, fault in pictures.computed_inputs(node, rules).items() if key not in same}
        if found:
            computed[material.name] = found
            sockets = [materials.principled_input(node, key) for key in found]
            causes[material.name] = set().union(*map(unroll.other_sources, sockets)) or set(found.values())
    means.use_means(context, shown, constant, folder)
    left = computed
    if computed and size > 0:
        left = {name: computed[name] for name in bake.bake(context, shown, computed, size)}
    means.use_means(context, shown, left, folder)
    for name in left:
        ledger.lose(f"a mean of what nodes compute ({', '.join(sorted(causes[name]))})", "material", name,
                    "what deforms cannot be baked" if size > 0 else "--bake 1024 makes pictures")
    return _finished(meshes, samples, ledger)


def _lit(emission):
    """An emission that is dark in the saved frame keeps its picture: other frames show it."""
    color, strength = emission
    return (color if max(color) > 0 else (1.0, 1.0, 1.0)), strength or 1.0


def _finished(meshes, samples, ledger):
    strengths, translucent, scales, colored = {}, set(), {}, set()
    for material in {s.material for o in meshes for s in o.material_slots}:
        output = materials.output_of(material.node_tree)
        found = output and materials.source_of(output.inputs["Surface"])
        if not found:
            continue
        if "ods_own" not in found.node:
            scales[material.name] = materials.albedo_scale(found.node)
        strengths[material.name] = materials.strength_of(found.node)
        if samples and material.name in samples.looks:
            strengths[material.name] = _lit(strengths[material.name])
            for frame in samples.looks[material.name] if "ods_peak" in material else []:
                frame["glow"] = [c * material["ods_peak"] for c in frame.get("glow", ())]
        if "ods_translucent" in material:
            translucent.add(material.name)
        if "ods_colors" in material:
            colored.add(material.name)
    materials.use_colors(meshes, ledger)
    return strengths, translucent, scales, colored


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


def _add_motion(glb, scene, samples, prepared, nodes, lamps, cameras, cut, ledger):
    clip = motion.Clip(glb, scene.name, samples)
    objects = dict(nodes)
    replaced = {index for index in objects.values() if "skin" not in glb.json["nodes"][index]}
    motion.add_objects(clip, glb, objects, samples)
    motion.add_points(clip, glb, objects, samples, ledger)
    motion.add_scattered(clip, glb, [(objects[each], copies) for each, copies in prepared.scattered if each in objects],
                         samples)
    motion.add_visibility(clip, glb, objects, samples)
    motion.add_seers(clip, cameras, samples)
    if cut is not None:
        motion.add_cuts(clip, cut, samples)
    motion.add_seers(clip, {lamp.key: lamp.node for lamp in lamps if lamp.key}, samples)
    motion.add_powers(clip, glb, [lamp for lamp in lamps if lamp.key], samples)
    motion.name_shapes(samples, ledger)
    motion.add_looks(clip, glb, samples)
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


def _join_sets(scene):
    """Blender renders the objects of a background set, which is another scene, with the scene's own."""
    joined, own = {scene}, scene.collection
    while (other := scene.background_set) and other not in joined:
        joined.add(other)
        for mine, theirs in ((own.children, other.collection.children), (own.objects, other.collection.objects)):
            for each in [each for each in theirs if each.name not in mine]:
                mine.link(each)
        scene.background_set = other.background_set if other.background_set not in joined else None


def _make_own(context, ledger):
    """Leaves the scene in object mode, with datablocks of its own and the render's settings."""
    scene = context.scene
    if bpy.ops.object.mode_set.poll() and context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    library.make_local()
    if tuple(bpy.data.version[:2]) > tuple(bpy.app.version[:2]):
        made, own = (".".join(map(str, v[:2])) for v in (bpy.data.version, bpy.app.version))
        ledger.say(f"it was saved by Blender {made} and opened by {own}: what is new there is missing")
    layers = [each.name for each in scene.view_layers if each.use and each != context.view_layer]
    if layers:
        ledger.say(f"only the view layer '{context.view_layer.name}' comes across, not {some(layers)}")
    _join_sets(scene)
    others = [each.name for each in bpy.data.scenes if each != scene]
    if others:
        ledger.say(f"the file has {len(others) + 1} scenes; this is '{scene.name}', --scene shows {some(others, 20)}")
    prepare.modify_as_rendered(scene)


def _follow(context, ledger, start):
    """What changes from frame to frame; None: nothing does. Leaves the scene in its saved frame."""
    scene, saved = context.scene, context.scene.frame_current
    if not motion.is_animated(scene):
        return None
    step("following what moves", 0.05)
    samples = motion.sample(context, materials.constants_of, ledger, start)
    scene.frame_set(saved)
    return samples


def _add_the_rest(glb, scene, prepared, samples, folder, ledger):
    """Lights, cameras, copies and motion. Returns the lights in the file."""
    marks = _nodes_by_mark(glb)
    nodes = {prepared.objects[mark]: index for mark, index in marks.items()}
    _add_unseen(glb, prepared, marks)
    meter = lights.Meter(folder)
    lamps = [lights.add_light(glb, *each, meter, samples, ledger) for each in prepared.lights]
    lamps = [lamp for lamp in lamps if lamp]
    lights.close({light for _, _, light, _ in prepared.lights}, ledger)
    seer, cut = motion.camera_at(scene, scene.frame_current), None
    if samples and len(set(samples.cameras)) > 1:
        cut = camera.add_node(glb, seer, seer.matrix_world, f"{seer.name}, as cut")
    seers = sorted((o for o in scene.objects if o.type == "CAMERA"), key=lambda o: o != seer)
    cameras = {each: camera.add_node(glb, each, each.matrix_world) for each in seers}
    _add_instances(glb, prepared, marks)
    if samples:
        _add_motion(glb, scene, samples, prepared, nodes, lamps, cameras, cut, ledger)
    else:
        glb.json.pop("animations", None)
    return lamps


def _describe(scene, samples, ledger):
    """What the command has to know besides the scene (bridge.json)."""
    render, seer = scene.render, motion.camera_at(scene, scene.frame_current)
    result = {
        "omnistereo_bridge": VERSION,
        "blender": ".".join(str(n) for n in bpy.app.version),
        "fps": render.fps / render.fps_base,
        "unit": scene.unit_settings.scale_length,
    }
    if samples:
        result["frames"] = {"first": scene.frame_start, "count": samples.count, "saved": scene.frame_current}
    if seer:
        result["camera"] = camera.describe(scene, seer, seer.matrix_world, ledger)
    if ledger.read(render, "use_motion_blur"):
        result["shutter"] = min(360.0, 360.0 * render.motion_blur_shutter)
    ledger.close("scene", [scene])
    if render.use_compositing and scene.use_nodes:
        ledger.say("the compositor does not come across")
    return result


def export_scene(context, folder, size=0, start=None):
    """Writes the files for the context's scene. size: of the pictures of computed materials; 0: none are made.
    start: the Beginning of the film, if only that is needed."""
    ledger, scene, reads = Ledger(), context.scene, _reads()
    _make_own(context, ledger)
    samples = _follow(context, ledger, start)
    prepared = prepare.prepare(context, samples, ledger)
    if samples:
        prepare.number_points(context, [each for each, frames in samples.points.items() if frames is not None])
    materials.name_missing_pictures(ledger)
    step("reading materials", 0.15)
    finished = _materials(context, prepared, samples, size, folder, ledger)
    step("exporting", 0.55)
    path = os.path.join(folder, "scene.glb")
    _run_exporter(path, scene)
    step("adding lights, camera and world", 0.8)
    glb = Glb(path)
    materials.finish_in_file(glb, *finished)
    lamps = _add_the_rest(glb, scene, prepared, samples, folder, ledger)
    step("rendering the world", 0.95)
    environment, background = world.export_world(glb, scene, folder, ledger)
    _strip_extras(glb)
    glb.json["asset"]["generator"] = f"Omnistereo's exporter in Blender {bpy.app.version_string}"
    glb.save(path)
    result = {**_describe(scene, samples, ledger), "reads": reads}
    glows = any(max(color) * strength > 0 for color, strength in finished[0].values())
    if lamps or glows or environment != "0,0,0":
        result["environment"] = environment  # else nothing shines, and ods finds some light
    if background is not None:
        result["background"] = background
    result["warnings"] = ledger.lines()
    with open(os.path.join(folder, "bridge.json"), "w", encoding="utf-8") as file:
        json.dump(result, file)
    return result


def _beginning(options):
    if "--beginning" not in options:
        return None
    return beginning.Beginning(*(int(options[k]) for k in ("--beginning", "--first", "--last") if k in options))


def main(arguments):
    """arguments: as above, from SCENE on. The exit code."""
    path, folder = arguments[0], arguments[1]
    options = dict(zip(arguments[2::2], arguments[3::2]))
    size = int(options.get("--bake", 0))
    try:
        opening.repair_numpy()
        opening.open_scene(path, options.get("--scene", ""))
        export_scene(bpy.context, folder, size, _beginning(options))
    except Failure as failure:
        say("error", failure)
        return 3
    except MemoryError:
        say("error", "Blender has run out of memory")
        return 3
    say("done", VERSION)
    return 0
