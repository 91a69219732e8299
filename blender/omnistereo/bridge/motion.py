# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What moves: the places of all objects and the power of all lights, frame by frame, as Blender evaluates them.

Constraints, drivers without Python and simulations are in it. Skins and shape keys come from Blender's own exporter.
"""
import time

import bpy
import numpy as np
from mathutils import Matrix

from . import lights
from .places import TO_GLTF, local_place, parts, smooth_rotations
from .report import say
from .simulation import simulates

MOST_FRAMES = 20000
MOST_POINTS = 20_000_000  # of all frames together; beyond this, only every n-th frame is kept
TIMED = {"WAVE", "OCEAN", "CLOTH", "SOFT_BODY", "FLUID", "DYNAMIC_PAINT", "MESH_SEQUENCE_CACHE", "MESH_CACHE", "BUILD",
         "EXPLODE", "PARTICLE_SYSTEM"}
MOVING_DATA = ("objects", "meshes", "curves", "lattices", "armatures", "shape_keys", "lights", "cameras", "materials",
               "node_groups", "worlds", "particles", "scenes", "metaballs", "textures")


def moves(owner):
    """Whether keys or drivers change a datablock."""
    trees = [owner, getattr(owner, "node_tree", None)]
    for data in (getattr(each, "animation_data", None) for each in trees):
        if data and (data.action or data.drivers or data.nla_tracks):
            return True
    return False


def is_animated(scene):
    if scene.frame_end <= scene.frame_start:
        return False
    if scene.rigidbody_world and scene.rigidbody_world.enabled:
        return True
    if len({marker.camera for marker in scene.timeline_markers if marker.camera}) > 1:
        return True
    if any(moves(each) for name in MOVING_DATA for each in getattr(bpy.data, name, ())):
        return True
    timed = {"GeometryNodeInputSceneTime", "GeometryNodeSimulationInput"}
    groups = [m.node_group for o in scene.objects for m in o.modifiers if m.type == "NODES" and m.node_group]
    return (any(m.type in TIMED for each in scene.objects for m in each.modifiers)
            or any(node.bl_idname in timed for group in groups for node in group.nodes))


def camera_at(scene, frame):
    """The camera that a marker binds to a frame, as Blender chooses it; else the scene's."""
    bound = sorted((m for m in scene.timeline_markers if m.camera), key=lambda m: m.frame)
    return ([m.camera for m in bound if m.frame <= frame] or [m.camera for m in bound[:1]] or [scene.camera])[-1]


class Samples:
    """By frame, for what changes: matrices, whether it is rendered, power of lights, looks of materials, points.
    The frames are those with these numbers, counted from 0, of all."""

    def __init__(self, scene):
        self.fps = scene.render.fps / scene.render.fps_base
        self.count = min(scene.frame_end - scene.frame_start + 1, MOST_FRAMES)
        self.numbers, self.times = [], []
        self.matrices, self.shown, self.powers, self.shapes, self.cameras = {}, {}, {}, {}, []
        self.looks = {}  # by material's name: dictionaries of constants
        self.points = {}  # by object: (points, normals), arrays; None: their number changes
        self.scattered = {}  # by (source, parent), then by the number of the copy: {index of the frame: matrix}
        self.saved = min(max(scene.frame_current, scene.frame_start), scene.frame_end) - scene.frame_start

    def just_before(self, time):
        """What changes at once does so a little earlier: times in the file are rounded."""
        return max(0.0, time - 0.01 / self.fps)

    def at_saved(self, values):
        return values[self.numbers.index(min(self.saved, self.numbers[-1]))]


def _points(each, depsgraph):
    evaluated = each.evaluated_get(depsgraph)
    mesh = evaluated.data if each.type == "MESH" else evaluated.to_mesh()
    if mesh is None:
        return None
    points, normals = np.empty(3 * len(mesh.vertices), np.float32), np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    mesh.vertices.foreach_get("normal", normals)
    if each.type != "MESH":
        evaluated.to_mesh_clear()
    return points, normals


def _may_deform(each):
    """Whether modifiers may move its points. The exporter follows joints, and shape keys that no modifier changes."""
    if each.type not in ("MESH", "CURVE", "SURFACE", "FONT", "META"):
        return False
    kinds = {m.type for m in each.modifiers} - {"PARTICLE_SYSTEM"}
    if "ARMATURE" in kinds:
        return False
    keyed = getattr(each.data, "shape_keys", None) is not None
    return bool(kinds) or (each.type != "MESH" and (moves(each.data) or keyed))


def _moving_points(moving, count):
    """The number of points in `count` frames. moving: the frames of each mesh."""
    return count * sum(len(frames[0][0]) // 3 for frames in moving if frames)


def _step_of(points):
    """Of so many points, those of every n-th frame are kept."""
    return max(1, -(-points // MOST_POINTS))


class _Slowness:
    """Tells the program that started us, once, when following what moves takes long."""

    PATIENCE, LONG = 1.0, 8.0  # seconds: before it judges, and of the rest

    def __init__(self, count):
        self.count, self.start, self.said = count, time.monotonic(), False

    def judge(self, done):
        taken = time.monotonic() - self.start
        rest = taken / done * (self.count - done)
        if not self.said and taken > self.PATIENCE and rest > self.LONG:
            self.said = True
            say("slow", f"{rest:.0f}")


def _frames_of(scene, samples, deforming, beginning):
    """Yields the numbers of the frames to read, after Blender has evaluated them."""
    if beginning is None:
        slowness = _Slowness(samples.count)
        for number in range(samples.count):
            scene.frame_set(scene.frame_start + number)
            yield number
            slowness.judge(number + 1)
        return
    scene.frame_set(scene.frame_start)
    yield 0  # it tells how many points move
    step = _step_of(_moving_points(deforming.values(), samples.count))
    simulated = simulates(scene)
    needed, through = beginning.needed(scene.frame_start, samples.count, samples.saved, step, simulated)
    for number in sorted(needed.union(range(through if simulated else 0)) - {0}):
        scene.frame_set(scene.frame_start + number)
        if number in needed:
            yield number


def sample(context, looks_of, ledger, beginning=None):
    """looks_of: material -> the constants of its look now. beginning: of the film, if that is all to read."""
    scene = context.scene
    samples = Samples(scene)
    if scene.frame_end - scene.frame_start >= MOST_FRAMES:
        ledger.say(f"the animation ends after {MOST_FRAMES} frames")
    keyed = [m for m in bpy.data.materials if m.users and m.node_tree and any(
        moves(tree) for tree in (m, *(n.node_tree for n in m.node_tree.nodes if n.type == "GROUP" and n.node_tree)))]
    deforming = {each: None for each in scene.objects if _may_deform(each)}
    for number in _frames_of(scene, samples, deforming, beginning):
        depsgraph = context.evaluated_depsgraph_get()
        samples.numbers.append(number)
        samples.times.append(number / samples.fps)
        samples.cameras.append(camera_at(scene, scene.frame_start + number))
        for each in scene.objects:
            evaluated = each.evaluated_get(depsgraph)
            samples.matrices.setdefault(each, []).append(evaluated.matrix_world.copy())
            samples.shown.setdefault(each, []).append(not evaluated.hide_render)
            if each.type == "LIGHT":
                samples.powers.setdefault(each, []).append(lights.power_of(evaluated.data))
                samples.shapes.setdefault(each, []).append(lights.shape_of(evaluated.data))
        for material in keyed:
            samples.looks.setdefault(material.name, []).append(looks_of(material))
        for each in list(deforming):
            _sample_points(each, depsgraph, deforming, samples)
        _sample_scattered(depsgraph, samples)
    samples.points = {each: frames for each, frames in deforming.items()
                      if frames is None or any(f is not frames[0] for f in frames)}
    return samples


def _sample_points(each, depsgraph, deforming, samples):
    found = _points(each, depsgraph)
    frames = deforming[each] if len(samples.times) > 1 else []
    if frames is None:
        return
    if found is None or (frames and len(frames[0][0]) != len(found[0])):
        deforming[each] = None  # their number changes
        return
    same = frames and all(np.array_equal(a, b) for a, b in zip(found, frames[0]))
    frames.append(frames[0] if same else found)
    deforming[each] = frames


def _sample_scattered(depsgraph, samples):
    """Copies that particles carry."""
    for each in depsgraph.object_instances:
        if each.is_instance and each.particle_system and each.parent:
            key = (each.object.original, each.parent.original)
            copy = samples.scattered.setdefault(key, {}).setdefault(tuple(each.persistent_id), {})
            copy[len(samples.times) - 1] = each.matrix_world.copy()


def _changes(matrices):
    first = matrices[0]
    return any((m[r][c] - first[r][c]) ** 2 > 1e-14 for m in matrices if m != first for r in range(4) for c in range(4))


class Clip:
    """One animation of the file, for all that moves. At rest the file is as it was saved."""

    def __init__(self, glb, name, samples):
        self.glb, self.samples = glb, samples
        self.animation = {"name": name, "channels": [], "samplers": []}
        self.input = None

    def add(self, target, values, kind, interpolation="LINEAR", times=None):
        if interpolation == "STEP":
            times = [self.samples.just_before(t) for t in self.samples.times]
        if self.input is None:
            self.input = self.glb.add_accessor(self.samples.times, "SCALAR")
        times = self.input if times is None else self.glb.add_accessor(times, "SCALAR")
        output = self.glb.add_accessor(values, kind)
        self.animation["samplers"].append({"input": times, "output": output, "interpolation": interpolation})
        self.animation["channels"].append({"sampler": len(self.animation["samplers"]) - 1, "target": target})

    def add_places(self, node, places, times=None):
        triples = [parts(p) for p in places]
        for key in ("matrix", "translation", "rotation", "scale"):
            self.glb.json["nodes"][node].pop(key, None)
        rotations = smooth_rotations([t[1] for t in triples])
        for path, values, kind in (("translation", [t[0] for t in triples], "VEC3"), ("rotation", rotations, "VEC4"),
                                   ("scale", [t[2] for t in triples], "VEC3")):
            self.glb.json["nodes"][node][path] = list(self.samples.at_saved(values))
            if any(any(abs(a - b) > 1e-7 for a, b in zip(v, values[0])) for v in values):
                self.add({"node": node, "path": path}, values, kind, times=times)

    def add_numbers(self, pointer, values, kind="SCALAR", interpolation="LINEAR"):
        """Of anything in the file, if they change."""
        if np.ptp(np.asarray(values, float), axis=0).max() <= 1e-6 * np.abs(values).max():
            return
        self.glb.use("KHR_animation_pointer")
        target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}
        self.add(target, values, kind, interpolation)


def _parents(glb):
    parents = {}
    for index, node in enumerate(glb.list("nodes")):
        for child in node.get("children", []):
            parents[child] = index
    return parents


def add_objects(clip, glb, nodes, samples):
    """nodes: of the file, by object. Skinned meshes are placed by their joints."""
    parents, owners = _parents(glb), {index: each for each, index in nodes.items()}
    done = set()
    for each, index in nodes.items():
        matrices = samples.matrices.get(each)
        parent = parents.get(index)
        if not matrices or "skin" in glb.json["nodes"][index] or (parent is not None and parent not in owners):
            continue
        above = samples.matrices.get(owners[parent]) if parent is not None else None
        local = [a.inverted_safe() @ m for a, m in zip(above, matrices)] if above else matrices
        if not _changes(local):
            continue
        clip.add_places(index, [local_place(m) for m in local])
        done.add(index)
    return done


def add_seers(clip, nodes, samples):
    """Cameras and lights: nodes by object, in the world's space."""
    for each, index in nodes.items():
        matrices = samples.matrices.get(each)
        if matrices and _changes(matrices):
            clip.add_places(index, [TO_GLTF @ m for m in matrices])


def add_cuts(clip, node, samples):
    """A node that is where the camera of each frame is; at a cut it is in both places at once."""
    times, places = [], []
    for index, (time, each) in enumerate(zip(samples.times, samples.cameras)):
        if index and each != samples.cameras[index - 1]:
            times += [samples.just_before(time)] * 2
            places += [samples.matrices[samples.cameras[index - 1]][index], samples.matrices[each][index]]
        times.append(time)
        places.append(samples.matrices[each][index])
    clip.add_places(node, [TO_GLTF @ m for m in places], times)
    for key, value in zip(("translation", "rotation", "scale"),
                          parts(TO_GLTF @ samples.at_saved(samples.matrices[samples.at_saved(samples.cameras)]))):
        clip.glb.json["nodes"][node][key] = value


def add_visibility(clip, glb, nodes, samples):
    """What is rendered in some frames only. It is a child of its node, as what it carries may be there all the time."""
    for each, index in nodes.items():
        shown = samples.shown.get(each)
        node = glb.json["nodes"][index]
        if not shown or all(shown) or not any(shown) or "mesh" not in node:
            continue
        if node.get("children"):
            child = {key: node.pop(key) for key in ("mesh", "skin", "weights") if key in node}
            index = glb.append("nodes", {"name": node.get("name", ""), **child})
            node["children"].append(index)
            node = glb.json["nodes"][index]
        node.setdefault("extensions", {})["KHR_node_visibility"] = {"visible": bool(samples.at_saved(shown))}
        glb.use("KHR_node_visibility")
        clip.add_numbers(f"/nodes/{index}/extensions/KHR_node_visibility/visible", [float(s) for s in shown],
                         interpolation="STEP")


def _add_glow(clip, glb, index, radiances):
    """A colour of emission that changes; colours are at most 1 in the file."""
    peaks = [max(max(r), 1e-9) for r in radiances]
    material = glb.json["materials"][index]
    material.setdefault("extensions", {}).setdefault("KHR_materials_emissive_strength", {})
    glb.use("KHR_materials_emissive_strength")
    material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = clip.samples.at_saved(peaks)
    colors = [[c / peak for c in r] if max(r) > 0 else [1.0] * 3 for r, peak in zip(radiances, peaks)]
    material["emissiveFactor"] = clip.samples.at_saved(colors)
    clip.add_numbers(f"/materials/{index}/extensions/KHR_materials_emissive_strength/emissiveStrength", peaks)
    clip.add_numbers(f"/materials/{index}/emissiveFactor", colors, "VEC3")


def add_powers(clip, glb, lamps, samples):
    for lamp in lamps:
        found, shown = samples.powers.get(lamp.key), samples.shown.get(lamp.key)
        if not found:
            continue
        radiances = [[f * p * is_on for f, p in zip(lamp.factor, power)] for power, is_on in zip(found, shown)]
        if np.ptp(np.asarray(radiances), axis=0).max() <= 1e-6 * np.max(radiances):
            continue
        if lamp.material is not None:
            _add_glow(clip, glb, lamp.material, radiances)
            continue
        peaks = [max(max(r), 1e-9) for r in radiances]
        clip.add_numbers(f"/extensions/KHR_lights_punctual/lights/{lamp.light}/intensity", peaks)
        clip.add_numbers(f"/extensions/KHR_lights_punctual/lights/{lamp.light}/color",
                         [[c / peak for c in r] for r, peak in zip(radiances, peaks)], "VEC3")


def name_shapes(samples, ledger):
    for each, frames in samples.shapes.items():
        if any(abs(a - b) > 1e-4 for frame in frames for a, b in zip(frame, frames[0])):
            ledger.lose("a size or an angle that changes does not come across", "light", each.name)


def add_looks(clip, glb, samples):
    """Materials whose constants change."""
    for index, material in enumerate(glb.list("materials")):
        frames = samples.looks.get(material.get("name"))
        if not frames:
            continue
        if all("glow" in f for f in frames) and any(f["glow"] != frames[0]["glow"] for f in frames):
            _add_glow(clip, glb, index, [f["glow"] for f in frames])
        body = material.setdefault("pbrMetallicRoughness", {})
        for key, name in (("metallic", "metallicFactor"), ("roughness", "roughnessFactor")):
            if all(key in f for f in frames) and any(f[key] != frames[0][key] for f in frames):
                body[name] = clip.samples.at_saved(frames)[key]
                clip.add_numbers(f"/materials/{index}/pbrMetallicRoughness/{name}", [f[key] for f in frames])
        colors = [[*f["color"][:3], f["alpha"]] for f in frames if "color" in f and "alpha" in f]
        if len(colors) == len(frames) and any(c != colors[0] for c in colors):
            body["baseColorFactor"] = clip.samples.at_saved(colors)
            clip.add_numbers(f"/materials/{index}/pbrMetallicRoughness/baseColorFactor", colors, "VEC4")
            if min(c[3] for c in colors) < 1.0:
                material["alphaMode"] = "BLEND"


def add_points(clip, glb, nodes, samples, ledger):
    """Meshes that change their points: what each frame adds to the saved one, as a morph target."""
    moving = {each: frames for each, frames in samples.points.items() if frames is not None}
    for each in samples.points.keys() - moving.keys():
        ledger.lose("a mesh whose number of points changes stays as it is in the saved frame", "object", each.name)
    total = _moving_points(moving.values(), samples.count)
    step = _step_of(total)
    if step > 1:
        ledger.say(f"{total} points move: of every {step} frames one is kept, and between them they go straight")
    for each, frames in moving.items():
        node = glb.json["nodes"][nodes[each]] if each in nodes else {}
        if "mesh" not in node:
            continue
        kept = [i for i, number in enumerate(samples.numbers) if number % step == 0 or number == samples.numbers[-1]]
        rest = samples.at_saved(frames)
        for primitive in glb.json["meshes"][node["mesh"]]["primitives"]:
            corners = _point_numbers(glb, primitive)
            targets = []
            for frame in kept:
                target = {}
                for name, now, still in zip(("POSITION", "NORMAL"), frames[frame], rest):
                    change = (now - still).reshape(-1, 3)[corners]
                    target[name] = glb.add_accessor(np.stack([change[:, 0], change[:, 2], -change[:, 1]], 1), "VEC3")
                targets.append(target)
            primitive["targets"] = targets
        node["weights"] = [0.0] * len(kept)  # as it was saved
        clip.add({"node": nodes[each], "path": "weights"}, np.eye(len(kept)), "SCALAR",
                 times=[samples.times[f] for f in kept])


def _point_numbers(glb, primitive):
    """Which point of Blender's mesh each of the file's is: in a UV map of prepare.number_points(), the last."""
    attributes = primitive["attributes"]
    name = max(n for n in attributes if n.startswith("TEXCOORD_"))
    values = glb.read_floats(attributes.pop(name))
    return np.rint(values[:, 0] + (1.0 - values[:, 1]) * 4096).astype(int)


def add_scattered(clip, glb, groups, samples):
    """Each copy that particles carry is a node; it has no size while it is not there."""
    for index, copies in groups:
        node = glb.json["nodes"][index]
        mesh = node.pop("mesh")
        for number, copy in enumerate(copies.values()):
            known = [copy[min(copy, key=lambda f: abs(f - frame))] for frame in range(len(samples.times))]
            places = [local_place(m if frame in copy else m @ Matrix.Scale(0.0, 4))
                      for frame, m in enumerate(known)]
            added = glb.add_root({"name": f"{node.get('name', '')} {number}", "mesh": mesh})
            clip.add_places(added, places)


def merge(glb, clip, replaced):
    """The exporter's own channels, of all but replaced nodes, join the clip."""
    start = min((float(glb.read_floats(s["input"]).min()) for a in glb.list("animations") for s in a["samplers"]),
                default=0.0)
    inputs = {}
    for animation in glb.list("animations"):
        for channel in animation["channels"]:
            target = channel["target"]
            if target.get("node") in replaced and target["path"] != "weights":
                continue
            sampler = dict(animation["samplers"][channel["sampler"]])
            if sampler["input"] not in inputs:
                times = np.maximum(glb.read_floats(sampler["input"]) - start, 0.0)
                inputs[sampler["input"]] = glb.add_accessor(times, "SCALAR")
            sampler["input"] = inputs[sampler["input"]]
            clip.animation["samplers"].append(sampler)
            clip.animation["channels"].append({"sampler": len(clip.animation["samplers"]) - 1, "target": target})
    glb.json["animations"] = [clip.animation] if clip.animation["channels"] else []
