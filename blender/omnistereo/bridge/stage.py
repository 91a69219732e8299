# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""A scene of our own beside the user's, in which Cycles measures one thing."""
import math

import bpy
import numpy as np


class Stage:
    """An empty scene with a camera that looks along +Y, and perhaps a world."""

    def __init__(self, world=None):
        self.scene = scene = bpy.data.scenes.new("ods stage")
        scene.frame_set(bpy.context.scene.frame_current)  # pictures that change
        scene.world = world
        if world:
            world.cycles.sampling_method = "NONE"  # nothing is lit by it here
        self.data = bpy.data.cameras.new("ods stage")
        self.camera = bpy.data.objects.new("ods stage", self.data)
        scene.collection.objects.link(self.camera)
        scene.camera = self.camera
        self.camera.rotation_euler = (math.pi / 2, 0, 0)
        render, cycles = scene.render, scene.cycles
        render.engine = "CYCLES"
        cycles.device = "CPU"
        cycles.use_denoising = False
        cycles.use_adaptive_sampling = False
        cycles.max_bounces = 0
        cycles.pixel_filter_type = "BOX"
        cycles.sample_clamp_direct = 0
        render.film_transparent = world is None
        render.use_compositing = render.use_sequencer = False
        render.resolution_percentage = 100
        render.use_file_extension = False
        image = render.image_settings
        image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR", "32", "ZIP"
        image.color_mode = "RGBA" if render.film_transparent else "RGB"

    def render(self, path, width, height, samples):
        self.scene.render.resolution_x, self.scene.render.resolution_y = width, height
        self.scene.cycles.samples = samples
        self.scene.render.filepath = path
        bpy.ops.render.render(write_still=True, scene=self.scene.name)

    def remove(self):
        bpy.data.scenes.remove(self.scene)
        bpy.data.cameras.remove(self.data)


def pixels(path):
    """Of a picture that a stage has rendered: height x width x channels, scene-linear."""
    image = bpy.data.images.load(path, check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "PREMUL"
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(image.size[1], image.size[0], -1).astype(np.float64)
    bpy.data.images.remove(image)
    return values
