// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The targets with their own stereo 360 camera, described by parameters: the POV-Ray fork, Arnold.
// docs/camera-export.md gives the source of each name.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ods/export/camera_formula.h"
#include "ods/export/writers.h"

namespace ods {
namespace {

// The system's names of a layout and the eyes; empty if the system does not support it.
struct ModeNames {
  std::string_view mono, left, right, side_by_side, top_bottom;
};

std::string_view mode_name(const Sidecar& file, const ModeNames& names) {
  if (file.eyes.size() == 1) {
    return file.eyes[0] == kMono ? names.mono : file.eyes[0] == kLeft ? names.left : names.right;
  }
  if (file.layout == Layout::kSideBySide) return names.side_by_side;
  if (file.layout == Layout::kTopBottom) return names.top_bottom;
  return "";
}

std::string no_layout(const Sidecar& file, std::string_view system) {
  return fmt::format("{} has no layout {}", system, layout_name(file.layout));
}

void warn_of_projection(const Sidecar& file, std::string_view system, std::vector<std::string>& warnings) {
  if (file.camera.projection.kind == kLatLong) return;
  warnings.push_back(
      fmt::format("{} has no projection {}: using lat-long instead", system, projection_name(file.camera.projection)));
}

}  // namespace

CameraExport to_povray_fork(const Sidecar& file) {
  const StereoCamera& stereo = file.camera;
  std::vector<std::string> faults = lacking(file, {.system = "the fork"});
  std::erase_if(faults, [](const std::string& fault) { return fault.ends_with("mirrored world"); });
  std::string_view mode = mode_name(file, {"1", "1", "2", "3", "4"});
  if (mode.empty()) faults.push_back(no_layout(file, "the fork"));
  if (stereo.projection.kind != kLatLong) {
    faults.push_back(fmt::format("the fork has no projection {}", projection_name(stereo.projection)));
  }
  const bool merged = stereo.top.mode == kMergeCosine && stereo.top.start == 0.0f && stereo.top.end == 90.0f;
  if (!same_merge(stereo.top, stereo.bottom) || (stereo.top.mode != kMergeNone && !merged)) {
    faults.push_back(
        fmt::format("its merge is a power of the cosine from 0 to 90 degrees, not {}", merge_text(stereo)));
  }
  if (!faults.empty()) {
    const char* instead = formula_fault(file).empty() ? " (--for povray has it all)" : "";
    return {"", {}, fmt::format("{}{}", fmt::join(faults, "; "), instead)};
  }
  const bool mono = file.eyes.size() == 1 && file.eyes[0] == kMono;
  CameraExport result;
  result.text = comment_block("//", "The POV-Ray fork's camera: " + camera_title(file) + ".", {});
  result.text += "// POV-Ray's world is left-handed: z is ours turned round. Lengths are metres.\n";
  if (mono) result.text += "// An eye without a distance to the other is the middle.\n";
  result.text += fmt::format(
      "camera {{\n  spherical\n  ods {}\n  ipd {}\n  ods_angle {}\n  ods_modulation {}\n  ods_handedness {}\n"
      "  location <{}, {}, {}>\n}}\n",
      mode, mono ? 0.0f : stereo.ipd, stereo.mirrored ? -stereo.yaw : stereo.yaw, merged ? stereo.top.exponent : 0.0f,
      stereo.mirrored ? 1 : -1, stereo.position.x, stereo.position.y,
      stereo.position.z == 0.0f ? 0.0f : -stereo.position.z);
  return result;
}

namespace {

// Arnold's vr_camera in its own terms; Maya's attributes are derived from them.
struct VrCamera {
  std::string_view mode;
  std::string_view projection;
  std::string_view top_mode;
  std::string_view bottom_mode;
  float separation;
  float top_angle;
  float bottom_angle;
};

VrCamera vr_camera(const Sidecar& file, std::vector<std::string>& warnings) {
  const StereoCamera& stereo = file.camera;
  warnings = lacking(file, {.system = "Arnold", .tilt = true, .neck = true});
  VrCamera camera{mode_name(file, {"left_eye", "left_eye", "right_eye", "side_by_side", "over_under"}),
                  "latlong",
                  "none",
                  "none",
                  file.eyes.size() == 1 && file.eyes[0] == kMono ? 0.0f : stereo.ipd,
                  90.0f,
                  90.0f};
  if (camera.mode.empty()) {
    warnings.push_back(no_layout(file, "Arnold") + "; using over_under instead");
    camera.mode = "over_under";
  }
  if (stereo.projection.kind == kCube3x2) camera.projection = "cubemap_3x2";
  if (stereo.projection.kind == kCube6x1) camera.projection = "cubemap_6x1";
  if (camera.projection == "latlong") warn_of_projection(file, "Arnold", warnings);
  const auto merge = [&](const PoleMergeSetting& setting, std::string_view& mode, float& angle, const char* pole) {
    if (setting.mode == kMergeNone) return;
    mode = setting.mode == kMergeMap ? "shader" : "cosine";
    angle = 90.0f - setting.start;
    if (setting.mode == kMergeMap) {
      warnings.push_back(fmt::format("the merge map at the {} is to be linked as merge_shader by hand", pole));
    } else if (!is_plain_cosine(setting)) {
      warnings.push_back(
          fmt::format("its merge at the {} is a plain cosine up to the pole, not {}", pole, one_merge(setting)));
    }
  };
  merge(stereo.top, camera.top_mode, camera.top_angle, "top");
  merge(stereo.bottom, camera.bottom_mode, camera.bottom_angle, "bottom");
  return camera;
}

constexpr const char* kArnoldNote =
    "Untested: merge angles are measured from the pole, as in Arnold's manual; never used for rendering.\n";

}  // namespace

CameraExport to_arnold(const Sidecar& file) {
  CameraExport result;
  const VrCamera camera = vr_camera(file, result.warnings);
  result.text = comment_block("#", "Arnold's vr_camera: " + camera_title(file) + ". Metres.", result.warnings);
  result.text += std::string("# ") + kArnoldNote;
  if (const Extent size = picture_size(file); size.width > 0) {
    result.text += fmt::format("# Resolution {} x {}.\n", size.width, size.height);
  }
  std::string matrix;
  const std::array<glm::dvec3, 4> place = placement(file.camera);
  for (size_t i = 0; i < 4; i++) {
    matrix += fmt::format(" {:.8g} {:.8g} {:.8g} {}\n", place[i].x, place[i].y, place[i].z, i == 3 ? 1 : 0);
  }
  result.text += fmt::format(
      "vr_camera\n{{\n name ods\n matrix\n{} mode \"{}\"\n projection \"{}\"\n eye_separation {}\n eye_to_neck {}\n"
      " top_merge_mode \"{}\"\n top_merge_angle {}\n bottom_merge_mode \"{}\"\n bottom_merge_angle {}\n}}\n",
      matrix, camera.mode, camera.projection, camera.separation, file.camera.neck, camera.top_mode, camera.top_angle,
      camera.bottom_mode, camera.bottom_angle);
  return result;
}

CameraExport to_mtoa(const Sidecar& file) {
  CameraExport result;
  const VrCamera camera = vr_camera(file, result.warnings);
  const StereoCamera& stereo = file.camera;
  const auto place = [](std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) - words.begin();
  };
  std::string& text = result.text;
  text = comment_block("//", "MtoA's vr_camera, in MEL: " + camera_title(file) + ". Centimetres.", result.warnings);
  text += std::string("// ") + kArnoldNote;
  text +=
      "// Untested in Maya. Names and the order of menus are those of MtoA's camera attributes; look at the camera's "
      "Arnold\n"
      "// section after running this.\n"
      "string $c[] = `camera -name \"ods\"`;\n";
  text += fmt::format("setAttr ($c[0] + \".rotateOrder\") 2;  // zxy: roll, then pitch, then yaw\n");
  text += fmt::format("setAttr ($c[0] + \".translate\") -type \"double3\" {} {} {};\n", 100.0f * stereo.position.x,
                      100.0f * stereo.position.y, 100.0f * stereo.position.z);
  text += fmt::format("setAttr ($c[0] + \".rotate\") -type \"double3\" {} {} {};\n", stereo.pitch, 0.0f - stereo.yaw,
                      0.0f - stereo.roll);
  text += "setAttr ($c[1] + \".aiTranslator\") -type \"string\" \"vr_camera\";\n";
  const auto row = [&](const char* attribute, const auto& value, std::string_view word) {
    text += fmt::format("setAttr ($c[1] + \".{}\") {};{}{}\n", attribute, value, word.empty() ? "" : "  // ", word);
  };
  row("aiMode", place(camera.mode, {"side_by_side", "over_under", "left_eye", "right_eye"}), camera.mode);
  row("aiProjection", place(camera.projection, {"latlong", "cubemap_6x1", "cubemap_3x2"}), camera.projection);
  row("aiEyeSeparation", 100.0f * camera.separation, "");
  row("aiEyeToNeck", 100.0f * stereo.neck, "");
  row("aiTopMergeMode", place(camera.top_mode, {"none", "cosine", "shader"}), camera.top_mode);
  row("aiTopMergeAngle", camera.top_angle, "");
  row("aiBottomMergeMode", place(camera.bottom_mode, {"none", "cosine", "shader"}), camera.bottom_mode);
  row("aiBottomMergeAngle", camera.bottom_angle, "");
  return result;
}

}  // namespace ods
