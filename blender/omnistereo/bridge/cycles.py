# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Renders the open scene with Cycles and our camera, picture by picture, as the command orders it.

Started as `blender --background ... --python run.py -- render SCENE FOLDER [--scene NAME] [--camera NAME]`. Leaves
bridge.json in the folder, and then waits for order.1.json, order.2.json, ... there (cli/bridge/cycles_session.h).
Changes the open scene in memory and saves nothing.
"""
import json
import math
import os
import time

import bpy
from mathutils import Matrix, Vector

from . import camera, motion, opening
from .ledger import Ledger, some
from .places import FROM_GLTF, TO_GLTF
from .report import Failure, say
from .simulation import simulates

GPUS = ("OPTIX", "CUDA", "HIP", "ONEAPI", "METAL")
EYES = {0: "left", 1: "right"}  # kLeft and kRight; any other number is the middle


def put(owner, name, value):
    """Where this Blender has such a setting."""
    if hasattr(owner, name):
        setattr(owner, name, value)


class Seers:
    """The camera of the file that each frame is seen from."""

    def __init__(self, scene, name):
        self.bound = sorted(((m.frame, m.camera) for m in scene.timeline_markers if m.camera), key=lambda b: b[0])
        self.fixed = scene.camera
        self.cuts = len({seer for _, seer in self.bound}) > 1
        if name and name != "none":
            self.bound, self.fixed, self.cuts = [], scene.objects.get(name), False
            if self.fixed is None or self.fixed.type != "CAMERA":
                names = sorted(o.name for o in scene.objects if o.type == "CAMERA")
                raise Failure(f"--camera: it has no camera '{name}'" + (f", only {some(names, 20)}" if names else ""))
        elif name:
            self.bound, self.fixed = [], None
        for marker in scene.timeline_markers:  # they would take another camera than ours
            marker.camera = None

    def at(self, frame):
        before = [seer for first, seer in self.bound if first <= frame] or [seer for _, seer in self.bound[:1]]
        return before[-1] if before else self.fixed


def _gpu(scene):
    """Cycles on a graphics card, if this Blender has one. Its settings at the factory name none."""
    preferences = bpy.context.preferences.addons["cycles"].preferences
    for kind in GPUS:
        try:
            preferences.compute_device_type = kind
        except TypeError:
            continue  # not in this Blender
        getattr(preferences, "refresh_devices", preferences.get_devices)()
        found = [each for each in preferences.devices if each.type == kind]
        for each in preferences.devices:
            each.use = each.type == kind
        if found:
            scene.cycles.device = "GPU"
            return found[0].name
    scene.cycles.device = "CPU"
    return ""


def _choose_device(scene, wanted):
    """wanted: cpu, gpu, auto, or nothing for the file's own. Returns the card; empty: the processor."""
    chosen = wanted or scene.cycles.device.lower()
    name = _gpu(scene) if chosen in ("gpu", "auto") else ""
    if wanted == "gpu" and not name:
        raise Failure("--device gpu: this Blender finds no graphics card for Cycles; --device cpu renders")
    if chosen == "gpu" and not name:
        name = "the processor: the file chooses a graphics card, and this Blender finds none for Cycles"
    if scene.cycles.device != "GPU" or not name:
        scene.cycles.device = "CPU"
    return name


def _losses(scene):
    """Lines about what Blender's own render of this scene has and ours has not."""
    lines, render = [], scene.render
    if render.use_compositing and (getattr(scene, "compositing_node_group", None) or scene.use_nodes):
        lines.append("the compositor is not applied")
    layers = [layer.name for layer in scene.view_layers if layer.use]
    if len(layers) > 1:
        lines.append(f"only the view layer '{layers[0]}' is rendered, not {some(layers[1:], 8)}")
    if render.use_freestyle:
        lines.append("Freestyle draws no lines on a panorama")
    if render.use_sequencer and scene.sequence_editor and len(scene.sequence_editor.sequences_all) > 0:
        lines.append("the video sequencer is not applied")
    if render.engine != "CYCLES":
        lines.append(f"the file is made for the engine {render.engine}: in Cycles it may look different")
    view = scene.view_settings
    if view.look not in ("None", "") or view.use_curve_mapping or abs(view.gamma - 1.0) > 1e-4:
        lines.append("look, curves and gamma of the colour management are not applied")
    return lines


def _prepare(scene):
    """Leaves a scene that renders only with Cycles, as a file of all passes that we read. Returns our camera."""
    render, cycles, image = scene.render, scene.cycles, scene.render.image_settings
    render.engine = "CYCLES"
    render.use_compositing = render.use_sequencer = render.use_freestyle = render.use_border = False
    render.use_stamp = render.use_file_extension = False
    put(render, "use_persistent_data", True)
    render.resolution_percentage, render.pixel_aspect_x, render.pixel_aspect_y = 100, 1.0, 1.0
    render.use_multiview, render.views_format = True, "STEREO_3D"
    put(image, "media_type", "MULTI_LAYER_IMAGE")
    image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
    image.views_format = "MULTIVIEW"
    put(cycles, "use_denoising", False)
    put(cycles, "use_animated_seed", False)
    layers = [layer for layer in scene.view_layers if layer.use] or list(scene.view_layers[:1])
    for layer in scene.view_layers:
        layer.use = layer == layers[0]
        layer.use_pass_combined = layer.use_pass_z = layer.use_pass_normal = True
        layer.cycles.denoising_store_passes = True
    data = bpy.data.cameras.new("ods")
    ours = bpy.data.objects.new("ods", data)
    scene.collection.objects.link(ours)
    ours.rotation_mode = "QUATERNION"
    data.type = "PANO"
    camera.panorama_of(data).panorama_type = "EQUIRECTANGULAR"
    data.stereo.use_spherical_stereo, data.stereo.pivot = True, "CENTER"
    scene.camera = ours
    return ours


def _picture_around(tree, path):
    """The shader of a lat-long picture with -Z of our world in its middle, where Blender has its own +X."""
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(path)
    picture.image.colorspace_settings.name = "Non-Color"
    place, mapping = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeMapping")
    mapping.vector_type = "POINT"
    mapping.inputs["Rotation"].default_value = (0.0, 0.0, -math.pi / 2)
    shader = tree.nodes.new("ShaderNodeBackground")
    tree.links.new(place.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], picture.inputs["Vector"])
    tree.links.new(picture.outputs["Color"], shader.inputs["Color"])
    return shader.outputs["Background"]


def _shader_of(world):
    """The shader of a world, to which another can be added."""
    tree = world.node_tree
    if world.use_nodes:
        output = tree.get_output_node("CYCLES")
        links = output.inputs["Surface"].links if output else ()
        if links:
            return links[0].from_socket
    color = (0.0, 0.0, 0.0) if world.use_nodes else world.color
    world.use_nodes = True
    shader = world.node_tree.nodes.new("ShaderNodeBackground")
    shader.inputs["Color"].default_value = (*color, 1.0)
    return shader.outputs["Background"]


def _surround(scene, light, background):
    """Replaces the world by pictures: the light around the scene, and what only the camera sees behind it."""
    if not light and not background:
        return
    kept = scene.world.copy() if scene.world and not light else None
    world = scene.world = kept or bpy.data.worlds.new("ods")
    if light:
        world.use_nodes = True
        world.node_tree.nodes.clear()
    shader = _picture_around(world.node_tree, light) if light else _shader_of(world)
    tree = world.node_tree
    if background:
        rays, mix = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMixShader")
        tree.links.new(rays.outputs["Is Camera Ray"], mix.inputs[0])
        tree.links.new(shader, mix.inputs[1])
        tree.links.new(_picture_around(tree, background), mix.inputs[2])
        shader = mix.outputs[0]
        put(getattr(world, "cycles_visibility", world), "camera", True)
        put(world, "visible_camera", True)
    output = tree.get_output_node("CYCLES") or tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(shader, output.inputs["Surface"])


def _describe(scene, seers):
    render, cycles, view = scene.render, scene.cycles, scene.view_settings
    seer = seers.at(scene.frame_current)
    result = {
        "blender": bpy.app.version_string,
        "fps": render.fps / render.fps_base,
        "unit": scene.unit_settings.scale_length,
        "now": scene.frame_current_final,
        "frames": {"first": scene.frame_start, "count": 0, "saved": scene.frame_current},
        "samples": cycles.samples,
        "exposure": view.exposure,
        "view": view.view_transform,
        "transparent": render.film_transparent,
        "warnings": _losses(scene),
    }
    if motion.is_animated(scene) or (seers.cuts and scene.frame_end > scene.frame_start):
        result["frames"]["count"] = scene.frame_end - scene.frame_start + 1
    if seer:
        result["camera"] = camera.describe(scene, seer, seer.matrix_world, Ledger())
        result["camera_name"] = seer.name
    if render.use_motion_blur:
        result["shutter"] = min(360.0, 360.0 * render.motion_blur_shutter)
    return result


class Renderer:
    def __init__(self, scene, seers):
        self.scene, self.seers, self.unit = scene, seers, scene.unit_settings.scale_length
        cycles = scene.cycles
        self.samples, self.threshold = cycles.samples, cycles.adaptive_threshold
        self.adapts, self.limit = cycles.use_adaptive_sampling, getattr(cycles, "time_limit", 0.0)
        self.clip_end = max([10000.0 / self.unit] + [each.clip_end for each in bpy.data.cameras])
        self.ours = _prepare(scene)
        self.frame = self.device = self.around = None
        self.simulated = scene.frame_start - 1 if simulates(scene) else math.inf  # the last frame that is computed

    def _go_to(self, frame):
        """Through all frames before it, where a simulation needs them: a farm or a still may ask for any."""
        while self.simulated < min(math.floor(frame), self.scene.frame_end):
            self.simulated += 1
            self.scene.frame_set(self.simulated)
        if frame != self.frame:
            self.scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))
            self.frame = frame

    def _pose(self, order, frame):
        """Position in our metres and yaw at a frame, and the matrix there."""
        position, yaw = order.get("position"), order.get("yaw")
        if position is None or yaw is None:
            self._go_to(frame)
            seer = self.seers.at(frame)
            if seer is None and position is None:
                raise Failure("it has no camera: --position X,Y,Z places one")
            if seer is not None:
                matrix = seer.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world
                if position is None:
                    position = [c * self.unit for c in (TO_GLTF @ matrix).translation]
                if yaw is None:
                    yaw = camera.attitude(matrix)[0]
        yaw = yaw or 0.0
        turned = (Matrix.Rotation(-math.radians(yaw), 4, "Y") @ Matrix.Rotation(math.radians(order["pitch"]), 4, "X")
                  @ Matrix.Rotation(-math.radians(order["roll"]), 4, "Z"))
        return position, yaw, FROM_GLTF @ Matrix.Translation(Vector(position) / self.unit) @ turned

    def _place(self, order):
        """Our camera at the order's frame; with motion blur also on its way there and on."""
        frame, ours = order["frame"], self.ours
        ours.animation_data_clear()
        for i, near in enumerate((frame - 1.0, frame + 1.0) if self.scene.render.use_motion_blur else ()):
            there = {**order, **order["around"][i]} if order["around"] else order
            location, rotation, _ = self._pose(there, near)[2].decompose()
            ours.location, ours.rotation_quaternion = location, rotation
            ours.keyframe_insert("location", frame=near)
            ours.keyframe_insert("rotation_quaternion", frame=near)
        position, yaw, matrix = self._pose(order, frame)
        location, rotation, _ = matrix.decompose()
        if ours.animation_data:
            if ours.rotation_quaternion.dot(rotation) < 0:
                rotation.negate()
        ours.location, ours.rotation_quaternion = location, rotation
        if ours.animation_data:
            ours.keyframe_insert("location", frame=frame)
            ours.keyframe_insert("rotation_quaternion", frame=frame)
            for curve in ours.animation_data.action.fcurves:
                for key in curve.keyframe_points:
                    key.interpolation = "LINEAR"
        self.frame = None
        self._go_to(frame)
        return {"position": position, "yaw": yaw}

    def _set_eyes(self, order):
        data, stereo, pano = self.ours.data, self.ours.data.stereo, camera.panorama_of(self.ours.data)
        for name, value in zip(("longitude_min", "longitude_max", "latitude_min", "latitude_max"), order["range"]):
            setattr(pano, name, math.radians(value))
        data.clip_start, data.clip_end = 0.001 / self.unit, self.clip_end
        view = EYES.get(order["eye"], "left")
        for each in self.scene.render.views:
            each.use = each.name == view
        stereo.interocular_distance = order["ipd"] / self.unit if order["eye"] in EYES else 0.0
        stereo.convergence_mode = "TOE" if order["toe_in"] else "PARALLEL"
        stereo.convergence_distance = order["convergence_distance"] / self.unit
        merge = order["merge"]
        stereo.use_pole_merge = merge is not None
        if merge:
            stereo.pole_merge_angle_from, stereo.pole_merge_angle_to = math.radians(merge[0]), math.radians(merge[1])
        data.dof.use_dof = order["lens_radius"] > 0.0
        if data.dof.use_dof:
            data.dof.focus_object = None
            data.dof.aperture_fstop = data.lens * 1e-3 / (2.0 * order["lens_radius"] / self.unit)
            data.dof.focus_distance = order["focus_distance"] / self.unit

    def _set_quality(self, order):
        """A part of a picture gets its share of the samples, and may be noisier."""
        cycles, render, parts = self.scene.cycles, self.scene.render, order["parts"]
        cycles.samples = max(1, round((order["samples"] or self.samples) / parts))
        noise = order.get("noise")
        cycles.use_adaptive_sampling = self.adapts if noise is None else noise > 0.0
        # At 0 Cycles chooses by the number of samples.
        cycles.adaptive_threshold = min(1.0, (noise or self.threshold) * math.sqrt(parts))
        put(cycles, "time_limit", (order["time_limit"] or self.limit) / parts)
        cycles.seed = order["seed"] & 0x7FFFFFFF
        if order.get("bounces") is not None:
            for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max", "volume"):
                setattr(cycles, f"{kind}_bounces", order["bounces"])
        if order.get("shutter") is not None:
            render.use_motion_blur = order["shutter"] > 0.0
            render.motion_blur_shutter = max(0.01, order["shutter"] / 360.0)
        if order["transparent"]:
            render.film_transparent = True
        for layer in self.scene.view_layers:
            layer.cycles.pass_debug_sample_count = order["statistics"]
        if order["threads"] > 0:
            render.threads_mode, render.threads = "FIXED", order["threads"]

    def render(self, order):
        """Without a path only the place is wanted."""
        if not order["path"]:
            position, yaw, _ = self._pose(order, order["frame"])
            return {"position": position, "yaw": yaw}
        if self.device is None:
            self.device = _choose_device(self.scene, order["device"])
            if self.device:
                say("device", self.device)
        if self.around != (order["light"], order["background"]):
            self.around = (order["light"], order["background"])
            _surround(self.scene, *self.around)
        render = self.scene.render
        render.resolution_x, render.resolution_y = order["size"]
        render.filepath = order["path"]
        self._set_quality(order)
        self._set_eyes(order)
        pose = self._place(order)
        self.scene.camera = self.ours
        try:
            bpy.ops.render.render(write_still=True, scene=self.scene.name)
        except RuntimeError as error:
            raise Failure(f"Cycles cannot render it: {opening.one_line(error)}") from None
        return pose


def _next_order(folder, number):
    path = os.path.join(folder, f"order.{number}.json")
    while not os.path.exists(path):
        time.sleep(0.01)
    with open(path, encoding="utf-8") as file:
        order = json.load(file)
    os.remove(path)
    return order


def serve(arguments):
    path, folder = arguments[0], arguments[1]
    options = dict(zip(arguments[2::2], arguments[3::2]))
    opening.repair_numpy()
    opening.open_scene(path, options.get("--scene", ""))
    scene = bpy.context.scene
    seers = Seers(scene, options.get("--camera", ""))
    with open(os.path.join(folder, "bridge.json"), "w", encoding="utf-8") as file:
        json.dump(_describe(scene, seers), file)
    renderer = Renderer(scene, seers)
    say("open", folder)
    number = 0
    while True:
        number += 1
        pose = renderer.render(_next_order(folder, number))
        say("rendered", json.dumps({"number": number, **pose}))


def main(arguments):
    """Ends with an error; otherwise the command ends it."""
    os.dup2(2, 1)  # Cycles' progress reaches the command line by line
    try:
        serve(arguments)
    except Failure as failure:
        say("error", failure)
    except MemoryError:
        say("error", "Blender has run out of memory")
    return 3
