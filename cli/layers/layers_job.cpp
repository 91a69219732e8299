// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/layers/layers_job.h"

#include <filesystem>

#include "cli/console/long_job.h"
#include "cli/render/device.h"
#include "ods/image/format/file_format.h"

namespace {

constexpr const char* kLayersExamples =
    "  ods layers scene.glb -o scene.layers.glb\n"
    "  ods layers house.blend -o house.usdz --position 0,1.6,0\n"
    "  ods layers scene.glb -o scene.layers.glb --plain     for Blender and every viewer of glTF\n"
    "  ods layers scene.glb -o site/ --export               a web page, also for browsers without a headset\n"
    "  ods layers room -o room.layers.glb --box 0.5 --quality final\n"
    "  ods layers toys -o toys.layers.glb --frames 0-192 --fps 24    a film: it plays while you move\n"
    "  ods layers picture_360_TB.exr -o picture.layers.glb  a picture with depth, without its scene\n"
    "  ods layers panorama.jpg --depth depth.png --depth-kind inverse --near 0.7 -o photo.layers.glb\n"
    "  ods view scene.layers.glb";

void add_layers_options(Options& options, LayersJob& job) {
  options.group("Layers");
  options.text("-o,--output", ValueKind::output_file(), job.render.output,
               "output file: .glb or .usdz; with --export a folder");
  options.flag("--export", job.is_page,
               "a web page: the viewer with the layered scene, and outside of the box a stereo picture made of it");
  options.number("--width", job.width, 256, 32768,
                 "sharpness: that of a lat-long panorama with this many pixels around. By default twice the width "
                 "that --quality gives a picture");
  options.number("--box", job.box, 0.02f, 2.0f, "side of the cube within which the eyes may move, metres");
  options.flag("--plain", job.write.plain, "without extensions of glTF that Blender cannot read: a larger file");
  options.choice("--textures", job.write.textures, ods::kLayerTexturesTable, "format of the textures in a .glb");
  options.number("--texture-quality", job.write.quality, 1, 100, "quality of the textures");
  options.text(
      "--fallback", "NAME", job.fallback,
      "name of a stereo picture from the same place, in the same folder: what viewers show outside of the box. Made of "
      "the layered scene if it does not exist");
  add_exposure_option(options, job.render);
  options.choice("--tone", job.render.tone, ods::kToneCurveTable, "tone curve",
                 std::string(ods::tone_curve_name(job.render.save.tone)));
}

// The files of a page are named after the scene, its folder may have a slash at the end.
void name_page(LayersJob& job) {
  if (!job.fallback.empty()) throw UsageError("--export makes its stereo picture itself: leave out --fallback");
  while (job.render.output.size() > 1 && job.render.output.ends_with('/')) job.render.output.pop_back();
  const std::string stem = std::filesystem::path(job.render.scene.name).stem();
  job.page_file = stem + ".layers.glb";
  job.fallback = stem + "_360_TB.jpg";
}

// The options for pictures with depth; all others are for scenes.
std::vector<std::string> picture_options() {
  std::vector<std::string> names{"--output",   "--export",          "--width",    "--box",      "--plain",
                                 "--textures", "--texture-quality", "--fallback", "--exposure", "--brighter",
                                 "--tone",     "--depth",           "--threads",  "--progress", "--quiet"};
  const std::vector<std::string> depth = depth_option_names();
  names.insert(names.end(), depth.begin(), depth.end());
  return names;
}

void check_picture_options(const Options& options, const LayersJob& job) {
  if (job.is_picture) {
    options.refuse_others(picture_options(), "is for scenes: a picture has its place and its light");
    if (job.depth.path.empty()) options.refuse(depth_option_names(), "goes with --depth FILE");
  } else {
    options.refuse({"--depth"}, "is for pictures: a scene has its own depth");
    if (job.render.time.frames.empty()) options.refuse({"--fps", "--light-every"}, "goes with --frames LIST");
    options.refuse(depth_option_names(), "is for pictures: a scene has its own depth");
  }
}

}  // namespace

LayersJob parse_layers(Options& options) {
  LayersJob job;
  options.describe(
      "Bakes what eyes see of a scene that move within a box: triangles with light, for headsets. Of a picture with\n"
      "depth it shows the surfaces that the picture shows, and guesses what is behind their edges.",
      kLayersExamples);
  add_scene_argument(options, job.render.scene);
  add_light_options(options, job.render.scene.light);
  add_layers_options(options, job);
  options.group("Place");
  add_place_options(options, job.render.camera);
  options.number("--yaw", job.render.camera.yaw, -36000.0f, 36000.0f, "where viewers look first, degrees to the right");
  options.number("--time", job.render.time.time, 0.0f, 1e6f, "the moment of an animated scene, seconds");
  add_animation_option(options, job.render.time);
  options.text(
      "--frames", "LIST|all", job.render.time.frames,
      "a film: what moves in these frames is geometry of its own, with an animation. 1-100, 1-100x2 (every other "
      "one), or all; as in ods video");
  options.number("--fps", job.render.time.given_fps, 0.01f, 1000.0f, "frames per second", "30");
  options.number("--light-every", job.light_every, 1, 1000,
                 "frames from one light of what moves to the next, which players mix; by default four lights a second, "
                 "or fewer if they would need 256 MB on graphics cards");
  add_quality_options(options, job.render);
  add_device_option(options, job.render);
  options.group("Console");
  add_restart_option(options, job.render.restart);
  add_progress_options(options, job.render.progress);
  add_depth_options(options, job.depth);
  options.parse();
  job.is_picture = ods::names_picture(job.render.scene.name);
  check_picture_options(options, job);
  if (job.render.output.empty()) throw UsageError("no output file: add -o scene.layers.glb");
  finish_render_options(options, job.render);
  if (!job.fallback.empty() && std::filesystem::path(job.fallback).has_parent_path()) {
    throw UsageError("--fallback is the name of a file in the output's folder, without a folder");
  }
  if (job.is_page) name_page(job);
  return job;
}
