# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""The panel "Stereo 360" in the render properties: the open scene, rendered by the command ods."""
import os

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty, StringProperty

from . import job

bl_info = {
    "name": "Omnistereo",
    "author": "The Omnistereo authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > Stereo 360",
    "description": "Renders stereo 360 pictures and videos with ods",
    "category": "Render",
}

running = None  # the Job, or the last one


class OmnistereoPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    program: StringProperty(name="ods", description="The command ods; empty: the one on PATH", subtype="FILE_PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


class OmnistereoSettings(bpy.types.PropertyGroup):
    quality: EnumProperty(name="Quality", default="preview", items=[
        ("draft", "Draft", "A first look"), ("preview", "Preview", "To judge by"), ("final", "Final", "To keep")])
    renderer: EnumProperty(name="Renderer", default="ods", items=[
        ("ods", "Omnistereo", "Fast, and both eyes as one"),
        ("cycles", "Cycles", "Blender's own, with our camera, for hair, smoke and any shader; the file's samples")])
    width: IntProperty(name="Width", description="Of one eye, in pixels", default=2048, min=64, max=16384, step=64)
    bake: IntProperty(name="Bake", default=0, min=0, max=8192,
                      description="Pixels of the pictures that are made of materials computed by nodes; 0: none")
    restart: BoolProperty(name="Restart", description="Discard what an interrupted render has left, and start over")
    output: StringProperty(name="Output", default="//", subtype="DIR_PATH", description="Folder of what is rendered")


def program():
    add_on = bpy.context.preferences.addons.get(__package__)
    return job.find_program(add_on.preferences.program if add_on else "")


def scene_name():
    return os.path.splitext(os.path.basename(bpy.data.filepath))[0] or "untitled"


def write_scene():
    """The scene as it stands, in a folder of its own; the open file stays what it is."""
    folder = job.private_folder()
    path = os.path.join(folder, scene_name() + ".blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True, check_existing=False, relative_remap=True)
    return folder, path


def output_of(settings, ending):
    folder = bpy.path.abspath(settings.output) if settings.output else ""
    if not folder or (settings.output.startswith("//") and not bpy.data.filepath):
        folder = os.path.expanduser("~")
    return os.path.join(folder, scene_name() + "_360_TB" + ending)


def words_of(kind, settings, path):
    words = [program(), kind, path]
    if kind == "view":
        return words
    words += ["--blender", bpy.app.binary_path, "--width", str(settings.width),
              "--progress", "json", "-o", output_of(settings, ".mp4" if kind == "video" else ".png")]
    words += ["--restart"] if settings.restart else []
    if settings.renderer == "cycles":
        return words + ["--renderer", "cycles"]
    words += ["--quality", settings.quality]
    return words + (["--bake", str(settings.bake)] if settings.bake else [])


class OmnistereoRun(bpy.types.Operator):
    """Render with ods"""
    bl_idname = "omnistereo.run"
    bl_label = "Stereo 360"
    kind: EnumProperty(items=[("render", "Render", "A picture of this moment"), ("video", "Video", "The animation"),
                              ("view", "View", "Look around while it renders, in the browser")])
    timer = None

    @classmethod
    def poll(cls, context):
        return running is None or not running.is_running()

    def execute(self, context):
        global running
        if not program():
            self.report({"ERROR"}, "ods is not found: install it, or name it in the add-on's preferences")
            return {"CANCELLED"}
        folder, path = write_scene()
        words = words_of(self.kind, context.scene.omnistereo, path)
        running = job.Job(words, folder)
        if self.kind == "view":
            return {"FINISHED"}
        if bpy.app.background:
            running.wait()
            return self.finish(context)
        self.timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.progress_begin(0, 1000)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            running.cancel()
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        for area in context.window.screen.areas if context.window else []:
            if area.type == "PROPERTIES":
                area.tag_redraw()
        context.window_manager.progress_update(int(1000 * running.share))
        return {"PASS_THROUGH"} if running.is_running() else self.finish(context)

    def finish(self, context):
        if self.timer:
            context.window_manager.event_timer_remove(self.timer)
            context.window_manager.progress_end()
        if running.cancelled:
            self.report({"INFO"}, "Cancelled")
            return {"CANCELLED"}
        if running.code != 0:
            self.report({"ERROR"}, running.error or "ods failed")
            return {"CANCELLED"}
        self.report({"INFO"}, "Rendered " + running.words[running.words.index("-o") + 1])
        return {"FINISHED"}


class OmnistereoCancel(bpy.types.Operator):
    """Stop ods; what it has of a video's frames is kept"""
    bl_idname = "omnistereo.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, context):
        return running is not None and running.is_running()

    def execute(self, context):
        running.cancel()
        return {"FINISHED"}


class OmnistereoPanel(bpy.types.Panel):
    bl_label = "Stereo 360"
    bl_idname = "RENDER_PT_omnistereo"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"

    def draw(self, context):
        layout, settings = self.layout, context.scene.omnistereo
        layout.use_property_split = True
        for name in ("renderer", "quality", "width", "bake", "output", "restart"):
            layout.prop(settings, name)
        row = layout.row(align=True)
        for kind, icon in (("render", "RENDER_STILL"), ("view", "HIDE_OFF"), ("video", "RENDER_ANIMATION")):
            row.operator("omnistereo.run", text=kind.capitalize(), icon=icon).kind = kind
        if running is None:
            return
        if running.is_running():
            row = layout.row()
            bar = f"{100 * running.share:.0f} %"
            row.progress(factor=running.share, text=bar) if hasattr(row, "progress") else row.label(text=bar)
            row.operator("omnistereo.cancel", icon="X")
        elif running.error and not running.cancelled:
            layout.label(text=running.error, icon="ERROR")
        if running.warnings:
            box = layout.box()
            box.label(text="What will not come across")
            for warning in running.warnings:
                box.label(text=warning, icon="DOT")


CLASSES = (OmnistereoPreferences, OmnistereoSettings, OmnistereoRun, OmnistereoCancel, OmnistereoPanel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.omnistereo = PointerProperty(type=OmnistereoSettings)


def unregister():
    if running is not None and running.is_running():
        running.cancel()
    del bpy.types.Scene.omnistereo
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
