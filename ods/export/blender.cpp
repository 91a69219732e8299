// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Python that sets up a Blender scene's camera to match. If a version of Blender lacks a property, the script reports
// it when it runs.
#include <fmt/format.h>

#include "ods/export/writers.h"

namespace ods {
namespace {

constexpr const char* kPrologue = R"(import bpy
from math import radians
from mathutils import Matrix


def put(owner, name, value):
    try:
        setattr(owner, name, value)
    except (AttributeError, TypeError) as error:
        print("ods: unsupported: this Blender has no", name, "=", value, "-", error)


scene = bpy.context.scene
data = bpy.data.cameras.new("ods")
camera = bpy.data.objects.new("ods", data)
scene.collection.objects.link(camera)
scene.camera = camera
scene.render.engine = "CYCLES"
data.clip_start = 0.001
data.clip_end = 10000.0
# Blender's z is our y, its y is our -z.
)";

class Script {
 public:
  Script(const Sidecar& file, std::vector<std::string>& warnings)
      : file_(file), camera_(file.camera), warnings_(warnings) {
    warnings_ = lacking(file, {.system = "Blender", .tilt = true, .toe_in = true, .partial = true});
    place();
    lens();
    stereo();
    picture();
    for (const std::string& warning : warnings_) line("print(\"ods: unsupported: {}\")", warning);
  }

  const std::string& text() const { return text_; }

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }

  void place() {
    const std::array<glm::dvec3, 4> columns = placement(camera_);
    const auto row = [&](const char* end, int axis, double sign) {
      std::string numbers;
      for (const glm::dvec3& column : columns) numbers += fmt::format("{:.8g}, ", sign * column[axis] + 0.0);
      line("    ({}){}", numbers.substr(0, numbers.size() - 2), end);
    };
    line("camera.matrix_world = Matrix((");
    row(",", 0, 1.0);
    row(",", 2, -1.0);
    row(",", 1, 1.0);
    line("    (0, 0, 0, 1)))");
  }

  void lens() {
    const ProjectionSetting& setting = camera_.projection;
    if (setting.kind == kPerspective) return window();
    line("data.type = \"PANO\"");
    line("panorama = data if hasattr(data, \"panorama_type\") else data.cycles");
    if (setting.kind == kFisheye) return fisheye();
    line("panorama.panorama_type = \"EQUIRECTANGULAR\"");
    if (setting.kind != kLatLong) {
      warn(fmt::format("Blender cannot set the projection {}; using lat-long instead (--for osl has it)",
                       projection_name(setting)));
    }
    const ProjectionSetting range = setting.kind == kLatLong ? setting : ProjectionSetting();
    line("put(panorama, \"longitude_min\", radians({}))", range.longitude.x);
    line("put(panorama, \"longitude_max\", radians({}))", range.longitude.y);
    line("put(panorama, \"latitude_min\", radians({}))", range.latitude.x);
    line("put(panorama, \"latitude_max\", radians({}))", range.latitude.y);
  }

  void fisheye() {
    line("panorama.panorama_type = \"FISHEYE_EQUIDISTANT\"");
    line("put(panorama, \"fisheye_fov\", radians({}))", camera_.projection.fov);
    turned_lens();
  }

  void window() {
    line("data.type = \"PERSP\"");
    line("data.sensor_fit = \"HORIZONTAL\"");
    line("data.angle = radians({})", camera_.projection.fov);
    warn("a window's eyes stand on a circle square to the world's up, whatever the pitch");
    turned_lens();
  }

  // A lens that points elsewhere rotates the viewing circle with it, unless it only turns about the circle's axis.
  void turned_lens() {
    const ProjectionSetting& setting = camera_.projection;
    if (setting.tilt != 0.0f) warn(fmt::format("the lens cannot tilt {} degrees while the eyes stay", setting.tilt));
    if (setting.pan == 0.0f) return;
    line("camera.matrix_world = camera.matrix_world @ Matrix.Rotation(radians({}), 4, \"Y\")", 0.0f - setting.pan);
  }

  void stereo() {
    const bool mono = file_.eyes.size() == 1 && file_.eyes[0] == kMono;
    line("scene.render.use_multiview = {}", mono ? "False" : "True");
    if (mono) return;
    line("stereo = data.stereo");
    line("stereo.use_spherical_stereo = True");
    line("stereo.pivot = \"CENTER\"");
    line("stereo.interocular_distance = {}", camera_.ipd);
    line("stereo.convergence_mode = \"{}\"", camera_.convergence == kToeIn ? "TOE" : "PARALLEL");
    if (camera_.convergence == kToeIn) line("stereo.convergence_distance = {}", camera_.convergence_distance);
    const PoleMergeSetting& merge = camera_.top;
    const bool cosine = merge.mode == kMergeCosine && merge.exponent == 1.0f;
    const bool none = merge.mode == kMergeNone;
    if (!same_merge(camera_.top, camera_.bottom) || (!none && !cosine)) {
      warn(fmt::format("Blender's merge is a plain cosine, the same at both poles, not {}; it is left off",
                       merge_text(camera_)));
      return line("stereo.use_pole_merge = False");
    }
    line("stereo.use_pole_merge = {}", none ? "False" : "True");
    if (none) return;
    line("stereo.pole_merge_angle_from = radians({})", merge.start);
    line("stereo.pole_merge_angle_to = radians({})", merge.end);
  }

  void picture() {
    if (file_.eye.width > 0) {
      line("scene.render.resolution_x = {}", file_.eye.width);
      line("scene.render.resolution_y = {}", file_.eye.height);
    }
    line("scene.render.resolution_percentage = 100");
    if (file_.eyes.size() == 1) {
      if (file_.eyes[0] == kMono) return;
      return line("put(scene.render.views[\"{}\"], \"use\", False)", file_.eyes[0] == kLeft ? "right" : "left");
    }
    line("image = scene.render.image_settings");
    if (file_.layout == Layout::kSeparate) return views("INDIVIDUAL");
    if (file_.layout == Layout::kMultiview) return views("MULTIVIEW");
    views("STEREO_3D");
    line("packing = image.stereo_3d_format");
    const EyeArrangement eyes = arrangement_of(file_.layout);
    const bool wide = eyes.how == EyePacking::kBeside;
    const bool high = eyes.how == EyePacking::kStacked && !eyes.right_first;
    if (!wide && !high) {
      warn(fmt::format("Blender cannot set the layout {}; using top-bottom instead", layout_name(file_.layout)));
    }
    line("packing.display_mode = \"{}\"", wide ? "SIDEBYSIDE" : "TOPBOTTOM");
    line("packing.use_squeezed_frame = {}", eyes.squeezed ? "True" : "False");
    if (wide) {
      line("put(packing, \"use_sidebyside_crosseyed\", {})", eyes.right_first ? "True" : "False");
    }
  }

  void views(const char* format) {
    line("scene.render.views_format = \"STEREO_3D\"");
    line("image.views_format = \"{}\"", format);
  }

  void warn(const std::string& warning) { warnings_.push_back(warning); }

  const Sidecar& file_;
  const StereoCamera& camera_;
  std::vector<std::string>& warnings_;
  std::string text_;
};

}  // namespace

CameraExport to_blender(const Sidecar& file) {
  CameraExport result;
  const Script script(file, result.warnings);
  result.text = comment_block("#", "Blender 3.4 to 5.x: " + camera_title(file) + ".", result.warnings);
  result.text += "# Run it in the scene: blender scene.blend --python this.py\n";
  result.text += kPrologue + script.text();
  return result;
}

}  // namespace ods
