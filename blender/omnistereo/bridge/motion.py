# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What moves: the places of all objects and the power of all lights, frame by frame, as Blender evaluates them.

Constraints, drivers without Python and simulations are in it. Skins and shape keys come from Blender's own exporter.
"""
import numpy as np

from .places import TO_GLTF, local_place, parts, smooth_rotations

MOST_FRAMES = 20000


def is_animated(scene):
    if scene.frame_end <= scene.frame_start:
        return False
    if scene.rigidbody_world and scene.rigidbody_world.enabled:
        return True

    def moves(owner):
        data = getattr(owner, "animation_data", None)
        return bool(data and (data.action or data.drivers or data.nla_tracks))

    for each in scene.objects:
        if moves(each) or moves(each.data) or any(moves(getattr(m, "node_group", None)) for m in each.modifiers):
            return True
        if each.constraints and any(moves(getattr(c, "target", None)) for c in each.constraints):
            return True
        if getattr(each.data, "shape_keys", None) and moves(each.data.shape_keys):
            return True
    return False


class Samples:
    """By frame: matrices of objects, and energies of lights."""

    def __init__(self):
        self.times, self.matrices, self.energies = [], {}, {}


def sample(context, objects, lights, report):
    scene = context.scene
    fps = scene.render.fps / scene.render.fps_base
    last = scene.frame_end
    if last - scene.frame_start + 1 > MOST_FRAMES:
        last = scene.frame_start + MOST_FRAMES - 1
        report.warn(f"the animation ends after {MOST_FRAMES} frames")
    samples = Samples()
    for frame in range(scene.frame_start, last + 1):
        scene.frame_set(frame)
        depsgraph = context.evaluated_depsgraph_get()
        samples.times.append((frame - scene.frame_start) / fps)
        for each in objects:
            samples.matrices.setdefault(each, []).append(each.evaluated_get(depsgraph).matrix_world.copy())
        for each in lights:
            light = each.evaluated_get(depsgraph).data
            samples.energies.setdefault(each, []).append(light.energy)
    scene.frame_set(scene.frame_start)
    return samples


def _changes(matrices):
    first = matrices[0]
    return any((m[r][c] - first[r][c]) ** 2 > 1e-14 for m in matrices if m != first for r in range(4) for c in range(4))


class Clip:
    """One animation of the file, for all that moves."""

    def __init__(self, glb, name, times):
        self.glb, self.times = glb, times
        self.animation = {"name": name, "channels": [], "samplers": []}
        self.input = None

    def add(self, target, values, kind):
        if self.input is None:
            self.input = self.glb.add_accessor(self.times, "SCALAR")
        output = self.glb.add_accessor(values, kind)
        self.animation["samplers"].append({"input": self.input, "output": output, "interpolation": "LINEAR"})
        self.animation["channels"].append({"sampler": len(self.animation["samplers"]) - 1, "target": target})

    def add_places(self, node, places):
        triples = [parts(p) for p in places]
        for key in ("matrix", "translation", "rotation", "scale"):
            self.glb.json["nodes"][node].pop(key, None)
        rotations = smooth_rotations([t[1] for t in triples])
        for path, values, kind in (("translation", [t[0] for t in triples], "VEC3"), ("rotation", rotations, "VEC4"),
                                   ("scale", [t[2] for t in triples], "VEC3")):
            self.glb.json["nodes"][node][path] = list(values[0])
            if any(any(abs(a - b) > 1e-7 for a, b in zip(v, values[0])) for v in values):
                self.add({"node": node, "path": path}, values, kind)

    def add_number(self, pointer, values):
        self.glb.use("KHR_animation_pointer")
        self.add({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}, values, "SCALAR")


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


def add_powers(clip, lamps, samples):
    for lamp in lamps:
        energies = samples.energies.get(lamp.key)
        pointer, value, energy = lamp.pointer
        if energies and energy > 0 and max(energies) - min(energies) > 1e-6 * energy:
            clip.add_number(pointer, [value * max(e, 0.0) / energy for e in energies])


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
