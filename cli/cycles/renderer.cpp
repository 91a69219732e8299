// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/cycles/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "cli/bridge/foreign_scene.h"
#include "ods/base/error.h"
#include "ods/camera/cycles_camera.h"

namespace {

// The options that mean the same with Cycles. All others are refused, so that a new one is not ignored.
constexpr std::string_view kHonoured[] = {
    // the file
    "", "--renderer", "--blender", "--blender-limit", "--scene",
    // the picture
    "-o", "--size", "--width", "--height", "--eyes", "--layout", "--sidecar", "--transparent", "--exposure",
    "--brighter", "--tone",
    // the camera
    "--camera-file", "--camera", "--position", "--yaw", "--pitch", "--roll", "--camera-preset", "--ipd", "--merge",
    "--merge-top", "--merge-bottom", "--merge-map", "--merge-map-inverted", "--head-tilt-map", "--convergence",
    "--eye-to-neck", "--axis", "--lens", "--left-handed", "--projection", "--fov", "--range", "--face", "--sensor",
    "--lens-direction", "--lens-polynomial",
    // the light
    "--env", "--env-turn", "--env-strength", "--background",
    // time
    "--time", "--frames", "--only", "--fps", "--duration", "--turntable", "--fly-to", "--shutter", "--grain",
    "--skip-existing",
    // quality
    "--noise", "--samples", "--time-limit", "--denoise", "--bounces", "--seed", "--threads", "--device", "--restart",
    "--statistics",
    // parts
    "--part", "--parts", "--keep-parts",
    // videos
    "--target", "--codec", "--crf", "--bitrate", "--bits", "--chroma", "--encoder", "--preset", "--audio", "--apple",
    "--keep-frames", "--force", "--wait",
    // the console
    "--progress", "-q", "--quiet", "--no-color"};

struct Remedy {
  std::string_view option, text;
};
constexpr Remedy kRemedies[] = {
    {"--quality", "the file sets it; --width, --samples and --noise change it"},
    {"--lamp", "add a light in Blender, or use --renderer ods"},
    {"--light-unit", "Blender's lights are in watts"},
    {"--unlit", "--renderer ods shows colours without light"},
    {"--bake", "Cycles computes the materials"},
    {"--indirect", "the file sets its bounces and caustics; --bounces changes the first"},
    {"--caustics", "the file sets them (Light Paths)"},
    {"--clamp", "the file sets it (Light Paths, Clamping)"},
    {"--filter", "the file sets it (Film, Pixel Filter)"},
    {"--object-layer", "--renderer ods writes this layer"},
    {"--save-unfinished", "--time-limit makes the best picture of a time"},
    {"--confine", "Blender reads all files that the scene names"},
    {"--animation", "Blender plays the file's own; --frames chooses of it"},
    {"--variant", "a .blend has none; --scene chooses a scene"},
    {"--solid-glass", "in Cycles all closed glass is solid"},
    {"--unit", "the file has its unit"},
    {"--up", "in a .blend z is up"},
    {"--as", "the file's camera is used, or --position"},
    {"--portable", "Cycles has no such mode; --device cpu avoids differences of graphics cards"},
    {"--with", "link it in Blender, or use --renderer ods"},
    {"--at", "link it in Blender, or use --renderer ods"},
    {"--rig", "docs/slits.md renders slits in Blender"},
};

}  // namespace

void add_renderer_option(Options& options, Renderer& renderer) {
  options.choice(
      "--renderer", renderer, kRendererTable,
      "what renders: ods, or the Cycles of Blender with our camera, for a .blend with hair, smoke or shaders "
      "that ods does not have (docs/blender.md). Samples, noise, bounces and device are the file's unless an "
      "option gives them");
}

void check_cycles_options(const std::vector<GivenWord>& given) {
  for (const GivenWord& word : given) {
    if (word.name == "--device" && word.value != "cpu" && word.value != "gpu" && word.value != "auto") {
      throw UsageError(fmt::format("--device is cpu, gpu or auto with --renderer cycles, not '{}'", word.value));
    }
    if (std::ranges::find(kHonoured, word.name) != std::end(kHonoured)) continue;
    const auto* const remedy = std::ranges::find(kRemedies, word.name, &Remedy::option);
    const std::string instead(remedy == std::end(kRemedies) ? "--renderer ods has it" : remedy->text);
    throw UsageError(fmt::format("{} cannot be used with --renderer cycles: {}", word.name, instead));
  }
}

void check_cycles_scene(const std::string& scene) {
  if (is_blend(scene)) return;
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}' is not a .blend: --renderer cycles renders the files of "
                                                       "Blender, --renderer ods all others",
                                                       scene));
}

void check_cycles_camera(const ods::StereoCamera& camera) {
  const std::string lacks = ods::cycles_lacks(camera);
  if (lacks.empty()) return;
  throw ods::Error(
      ods::ErrorKind::kUsage,
      fmt::format("Cycles' stereo camera has {}; slits have every camera: ods rig (docs/slits.md)", lacks));
}
