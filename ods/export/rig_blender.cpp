// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Python that renders all views in Blender, with whatever engine the scene uses. Blender's depth of a perspective
// camera is along the axis. If a version of Blender lacks a property, the script reports it when it runs.
#include <fmt/format.h>

#include "ods/export/rig_writers.h"

namespace ods {

static constexpr const char* kBody = R"(
import os
import sys
import tempfile

import bpy
from mathutils import Matrix


def put(owner, name, value):
    try:
        setattr(owner, name, value)
    except (AttributeError, TypeError) as error:
        print("ods: this Blender has no", name, "=", value, "-", error)


def set_up(scene):
    data = bpy.data.cameras.new("ods view")
    data.sensor_fit = "HORIZONTAL"
    data.lens = 0.5 * data.sensor_width / HALF_WIDTH
    data.clip_start = 0.001
    data.clip_end = 10000.0
    camera = bpy.data.objects.new("ods view", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    for marker in scene.timeline_markers:  # they would take another camera
        marker.camera = None
    render = scene.render
    render.resolution_x, render.resolution_y = SIZE
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1.0
    render.use_border = False
    render.use_multiview = False
    render.use_stamp = False
    render.use_sequencer = False
    render.use_compositing = COMPOSITING
    put(render, "use_persistent_data", True)  # the scene stays in memory from view to view
    image = render.image_settings
    if hasattr(image, "media_type"):
        image.media_type = "MULTI_LAYER_IMAGE" if DEPTH else "IMAGE"
    image.file_format = "OPEN_EXR_MULTILAYER" if DEPTH else "OPEN_EXR"
    image.color_depth = "32" if DEPTH else "16"
    image.exr_codec = "ZIP"
    if DEPTH:
        bpy.context.view_layer.use_pass_z = True
    if hasattr(scene, "cycles"):
        put(scene.cycles, "use_animated_seed", False)
    return camera


def mark(folder, work):
    """Records the rig that the views belong to. A folder holds the views of one rig only."""
    path = os.path.join(folder, "ods-rig.txt")
    if os.path.exists(path):
        with open(path) as file:
            if MARK.split('"')[1] not in file.read():
                sys.exit("ods: %s: views of another rig. Remove the folder, or name another one" % path)
        return
    unfinished = os.path.join(work, "ods-rig.txt")
    with open(unfinished, "w") as file:
        file.write(MARK)
    os.replace(unfinished, path)


def render_view(scene, camera, number, folder, work):
    name = "%04d.exr" % number
    path, unfinished = os.path.join(folder, name), os.path.join(work, name)
    if os.path.exists(path) and os.path.getsize(path) > 0:
        return
    m = VIEWS[number - 1]
    camera.matrix_world = Matrix((m[0:4], m[4:8], m[8:12], (0, 0, 0, 1)))
    if hasattr(scene, "cycles"):
        scene.cycles.seed = SEED + number
    scene.render.filepath = unfinished
    bpy.ops.render.render(write_still=True)
    os.replace(unfinished, path)
    print("ods: view %d of %d: %s" % (number, len(VIEWS), path), flush=True)


def main():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    first = int(words[0]) if words else 1
    last = int(words[1]) if len(words) > 1 else len(VIEWS)
    folder = os.path.abspath(bpy.path.abspath(words[2] if len(words) > 2 else FOLDER))
    if not 1 <= first <= last <= len(VIEWS):
        sys.exit("ods: views are 1 to %d" % len(VIEWS))
    os.makedirs(folder, exist_ok=True)
    # Others may write in the folder, too, but not in this one.
    with tempfile.TemporaryDirectory(prefix=".unfinished.", dir=folder) as work:
        mark(folder, work)
        scene = bpy.context.scene
        camera = set_up(scene)
        for number in range(first, last + 1):
            render_view(scene, camera, number, folder, work)


main()
)";

RigExport rig_to_blender(const SlitRig& rig, const std::string& name) {
  RigExport result;
  const bool depth = rig.options.depth == ViewDepth::kPlane;
  const std::vector<std::string> lines = head_lines(
      rig, name,
      {"Blender 2.83 to 5.x",
       "views/####.exr",
       depth,
       {"  blender -b scene.blend --python-exit-code 1 -P " + name + ".blender.py",
        "  blender -b scene.blend --python-exit-code 1 -P " + name +
            ".blender.py -- 1 100   views 1 to 100, for a farm",
        "The frame that the scene is at is rendered, as is its world, engine and quality; existing views are kept.",
        "Noise: each view has a seed of its own, SEED and its number."}},
      result.warnings);
  std::string text = commented("#", lines);
  text +=
      "\nFOLDER = \"//views\"  # // is where the .blend is, or where Blender was started; a third word is another\n";
  text += "COMPOSITING = False  # True: the scene's compositor is applied to every view\nSEED = 0\n";
  text += fmt::format("MARK = {}\n", mark_literal(rig));
  text += fmt::format("DEPTH = {}\nSIZE = ({}, {})\n", depth ? "True" : "False", rig.view.width, rig.view.height);
  text += fmt::format("HALF_WIDTH = {:.10g}  # of a view, a metre ahead of it\n", half_size(rig).x);
  text += "# Three rows of four each: a view's matrix in Blender's world, whose z is our y and whose y is our -z.\n";
  text += "VIEWS = [\n";
  for (const StereoCamera& view : rig.views)
    text += fmt::format("    ({}),\n", matrix_rows(turned(pose_of(view), turn_z_up)));
  text += "]\n";
  result.scripts.push_back({".blender.py", text + kBody});
  return result;
}

}  // namespace ods
