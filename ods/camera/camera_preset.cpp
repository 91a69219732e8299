// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/camera_preset.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/camera/camera_fields.h"

namespace ods {
namespace {

// The values in use: given ones, or the defaults.
class Values {
 public:
  Values(const CameraPreset& preset, const std::map<std::string, std::string>& given)
      : preset_(preset), given_(given) {}

  std::string word(std::string_view name, std::initializer_list<std::string_view> words) const {
    const std::string value = text(name);
    if (std::find(words.begin(), words.end(), value) == words.end()) {
      throw std::invalid_argument(
          fmt::format("{}: {} is one of {}, not '{}'", preset_.name, name, fmt::join(words, ", "), value));
    }
    return value;
  }

  float number(std::string_view name, float low, float high) const {
    const std::string value = text(name);
    float number = 0.0f;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || !(number >= low && number <= high)) {
      throw std::invalid_argument(
          fmt::format("{}: {} is a number from {:g} to {:g}, not '{}'", preset_.name, name, low, high, value));
    }
    return number;
  }

  float number(std::string_view name, CameraField field) const {
    return number(name, range_of(field).minimum, range_of(field).maximum);
  }

 private:
  std::string text(std::string_view name) const {
    const auto found = given_.find(std::string(name));
    if (found != given_.end()) return found->second;
    for (const PresetParameter& parameter : preset_.parameters) {
      if (parameter.name == name) return std::string(parameter.value);
    }
    throw std::logic_error("a camera preset uses an undeclared parameter");
  }

  const CameraPreset& preset_;
  const std::map<std::string, std::string>& given_;
};

PoleMergeSetting merge_from(int mode, float start, float end, float exponent = 1.0f) {
  PoleMergeSetting merge;
  if (start >= end) return merge;  // it ends where it starts, so it merges nothing
  merge.mode = mode, merge.start = start, merge.end = end, merge.exponent = exponent;
  return merge;
}

StereoCamera plain(float ipd, const PoleMergeSetting& merge = {}) {
  StereoCamera camera;
  camera.ipd = ipd;
  camera.top = camera.bottom = merge;
  return camera;
}

constexpr PresetParameter kGoogle[] = {{"IPD", "0.064", "distance between the eyes"}};
StereoCamera like_google(const Values& values) {
  return plain(values.number("IPD", CameraField::kIpd));
}

// A power of the cosine decreases from the horizon on. Handedness -1 is a left-handed world, as in POV-Ray and unlike
// ours; the picture there is the same.
StereoCamera like_clodo(float ipd, float modulation, float handedness, float angle) {
  if (std::abs(handedness) != 1.0f) throw std::invalid_argument("povray: the handedness is -1 or 1");
  StereoCamera camera = plain(ipd, modulation >= range_of(CameraField::kTopMergeExponent).minimum
                                       ? merge_from(kMergeCosine, 0.0f, 90.0f, modulation)
                                       : PoleMergeSetting());
  camera.mirrored = handedness > 0.0f;
  camera.yaw = camera.mirrored ? -angle : angle;  // clockwise in the mirror
  return camera;
}

constexpr PresetParameter kPovray[] = {{"odsIPD", "0.065", "distance between the eyes"},
                                       {"odsVerticalModulation", "0.2", "power of the cosine of elevation"},
                                       {"odsHandedness", "-1", "-1 as POV-Ray's world, 1 mirrored"},
                                       {"odsAngle", "0", "clockwise, degrees"}};
StereoCamera like_povray(const Values& values) {
  return like_clodo(values.number("odsIPD", CameraField::kIpd), values.number("odsVerticalModulation", 0.0f, 100.0f),
                    values.number("odsHandedness", -1.0f, 1.0f), values.number("odsAngle", CameraField::kYaw));
}

constexpr PresetParameter kPovrayFork[] = {{"ipd", "0.065", "distance between the eyes"},
                                           {"ods_modulation", "0.2", "power of the cosine of elevation"},
                                           {"ods_handedness", "-1", "-1 as POV-Ray's world, 1 mirrored"},
                                           {"ods_angle", "0", "clockwise, degrees"}};
StereoCamera like_povray_fork(const Values& values) {
  return like_clodo(values.number("ipd", CameraField::kIpd), values.number("ods_modulation", 0.0f, 100.0f),
                    values.number("ods_handedness", -1.0f, 1.0f), values.number("ods_angle", CameraField::kYaw));
}

// The angle is measured from the pole: 90 merges from the horizon on.
constexpr PresetParameter kArnold[] = {{"eye_separation", "0.065", "distance between the eyes"},
                                       {"eye_to_neck", "0", "distance from the neck forward to the eyes, metres"},
                                       {"top_merge_mode", "cosine", "none, cosine"},
                                       {"top_merge_angle", "90", "from the pole, degrees"},
                                       {"bottom_merge_mode", "cosine", "none, cosine"},
                                       {"bottom_merge_angle", "90", "from the pole, degrees"}};
StereoCamera like_arnold(const Values& values) {
  const auto merge = [&](const char* mode, const char* angle) {
    const float start = 90.0f - values.number(angle, 0.0f, 90.0f);
    return values.word(mode, {"none", "cosine"}) == "none" ? PoleMergeSetting()
                                                           : merge_from(kMergeCosine, start, 90.0f);
  };
  StereoCamera camera = plain(values.number("eye_separation", CameraField::kIpd));
  camera.neck = values.number("eye_to_neck", CameraField::kNeck);
  camera.top = merge("top_merge_mode", "top_merge_angle");
  camera.bottom = merge("bottom_merge_mode", "bottom_merge_angle");
  return camera;
}

// The plug-in of the page, with latitudes, a linear mode and an exponent.
constexpr PresetParameter kArnoldProto[] = {
    {"eyeSeparation", "0.065", "distance between the eyes"},
    {"eyeToNeckDistance", "0", "distance from the neck forward to the eyes, metres"},
    {"topMergeMode", "cos", "none, linear, cos"},
    {"topMergeAngle", "0", "latitude, degrees"},
    {"topMergeExp", "1", "power of the cosine"},
    {"bottomMergeMode", "cos", "none, linear, cos"},
    {"bottomMergeAngle", "0", "latitude below the horizon, 0 to -90"},
    {"bottomMergeExp", "1", "power of the cosine"}};
StereoCamera like_arnold_proto(const Values& values) {
  const auto merge = [&](const std::string& pole, float angle) {
    const std::string mode = values.word(pole + "MergeMode", {"none", "linear", "cos"});
    const float exponent = values.number(pole + "MergeExp", CameraField::kTopMergeExponent);
    if (mode == "none") return PoleMergeSetting();
    return mode == "linear" ? merge_from(kMergeLinear, angle, 90.0f) : merge_from(kMergeCosine, angle, 90.0f, exponent);
  };
  StereoCamera camera = plain(values.number("eyeSeparation", CameraField::kIpd));
  camera.neck = values.number("eyeToNeckDistance", CameraField::kNeck);
  camera.top = merge("top", values.number("topMergeAngle", CameraField::kTopMergeStart));
  camera.bottom = merge("bottom", -values.number("bottomMergeAngle", -90.0f, 0.0f));
  return camera;
}

constexpr PresetParameter kCycles[] = {{"interocular_distance", "0.065", "distance between the eyes"},
                                       {"convergence_mode", "PARALLEL", "PARALLEL, OFFAXIS, TOE"},
                                       {"convergence_distance", "1.95", "metres"},
                                       {"use_pole_merge", "0", "1: merge"},
                                       {"pole_merge_angle_from", "60", "elevation, degrees"},
                                       {"pole_merge_angle_to", "75", "elevation, degrees"}};
StereoCamera like_cycles(const Values& values) {
  StereoCamera camera = plain(values.number("interocular_distance", CameraField::kIpd));
  const std::string mode = values.word("convergence_mode", {"PARALLEL", "OFFAXIS", "TOE"});
  camera.convergence = mode == "PARALLEL" ? kParallel : kToeIn;  // its two other modes are equivalent in a panorama
  camera.convergence_distance = values.number("convergence_distance", CameraField::kConvergenceDistance);
  const float from = values.number("pole_merge_angle_from", CameraField::kTopMergeStart);
  const float to = values.number("pole_merge_angle_to", CameraField::kTopMergeEnd);
  if (values.word("use_pole_merge", {"0", "1"}) == "1") camera.top = camera.bottom = merge_from(kMergeCosine, from, to);
  return camera;
}

constexpr PresetParameter kOspray[] = {{"interpupillaryDistance", "0.0635", "distance between the eyes"}};
StereoCamera like_ospray(const Values& values) {
  return plain(values.number("interpupillaryDistance", CameraField::kIpd), merge_from(kMergeCosine, 0.0f, 90.0f));
}

constexpr PresetParameter kDomemaster[] = {{"separation", "0.065", "distance between the eyes"},
                                           {"parallax_distance", "3.6", "where both eyes' rays meet, metres"}};
StereoCamera like_domemaster(const Values& values) {
  StereoCamera camera = plain(values.number("separation", CameraField::kIpd));
  camera.convergence = kToeIn;
  camera.convergence_distance = values.number("parallax_distance", CameraField::kConvergenceDistance);
  return camera;
}

constexpr PresetParameter kReplica[] = {{"radius", "0.032", "of the viewing circle"}};
StereoCamera like_replica(const Values& values) {
  return plain(2.0f * values.number("radius", 0.0f, 0.5f * range_of(CameraField::kIpd).maximum));
}

constexpr PresetParameter kMandelbulber[] = {{"stereo_eye_distance", "0.1", "of each eye from the middle"}};
StereoCamera like_mandelbulber(const Values& values) {
  return plain(2.0f * values.number("stereo_eye_distance", 0.0f, 0.5f * range_of(CameraField::kIpd).maximum),
               merge_from(kMergePower, 0.0f, 90.0f, 10.0f));
}

constexpr PresetParameter kIpdParameter[] = {{"ipd", "0.064", "distance between the eyes"}};
StereoCamera like_unmerged(const Values& values) {
  return plain(values.number("ipd", CameraField::kIpd));
}

StereoCamera like_evrydayvr(const Values& values) {
  return plain(values.number("ipd", CameraField::kIpd), merge_from(kMergeGaussian, 0.0f, 90.0f));
}

StereoCamera like_tmarrinan(const Values& values) {
  return plain(values.number("ipd", CameraField::kIpd), merge_from(kMergeLinear, 75.0f, 90.0f));
}

StereoCamera like_open_brush(const Values& values) {
  return plain(values.number("ipd", CameraField::kIpd), merge_from(kMergeTiltBrush, 0.0f, 72.0f));
}

constexpr PresetParameter kFading[] = {{"ipd", "0.065", "distance between the eyes"},
                                       {"merge_angle", "90", "from the pole, degrees"}};
StereoCamera like_houdini(const Values& values) {
  const float start = 90.0f - values.number("merge_angle", 0.0f, 90.0f);
  return plain(values.number("ipd", CameraField::kIpd), merge_from(kMergeSmoothstep, start, 90.0f));
}

struct Entry {
  CameraPreset preset;
  StereoCamera (*make)(const Values&);
};

constexpr Entry kEntries[] = {
    {{"google", "Google's page", true, "Rendering Omni-directional Stereo Content", kGoogle}, like_google},
    {{"povray", "POV-Ray 3.8 user_defined", true, "clodo.it, ODS with POV-Ray", kPovray}, like_povray},
    {{"povray-fork", "the POV-Ray fork", true, "Clodo76/povray, tracepixel.cpp; there the camera looks ahead only",
      kPovrayFork},
     like_povray_fork},
    {{"arnold", "Arnold's vr_camera", true, "formula of its prototype, angles as its manual has them", kArnold},
     like_arnold},
    {{"arnold-proto", "the VR camera for Arnold as first published", true, "source of the plug-in", kArnoldProto},
     like_arnold_proto},
    {{"cycles", "Blender's Cycles", true, "projection.h, spherical_stereo_transform; lens blur differs", kCycles},
     like_cycles},
    {{"ospray", "OSPRay, ANARI", true, "PanoramicCamera.ispc; the cosine lies in its unnormalised cross product",
      kOspray},
     like_ospray},
    {{"domemaster", "Domemaster3D LatLongStereo", true,
      "LatLongStereo.cpp; with maps for the merge and the head's tilt", kDomemaster},
     like_domemaster},
    {{"nerfstudio", "nerfstudio", true, "cameras.py", kGoogle}, like_google},
    {{"replica360", "Replica360, MatryODShka", true, "mesh-ptex-spherical.vert", kReplica}, like_replica},
    {{"mandelbulber", "Mandelbulber", true, "render_worker.cpp, infinite correction 0", kMandelbulber},
     like_mandelbulber},
    {{"unity", "Unity's ODSOffset", false, "its circle tilts with elevation, by the square of ipd over distance",
      kIpdParameter},
     like_unmerged},
    {{"unreal", "Unreal's panoramic capture", false, "slits: no two columns of ours share an eye point", kIpdParameter},
     like_unmerged},
    {{"open-brush", "Open Brush, Google's Unity kit", false, "its merge on unity's circle", kIpdParameter},
     like_open_brush},
    {{"evrydayvr", "eVRydayVR capture", false, "without its blending of captures and its mono caps", kIpdParameter},
     like_evrydayvr},
    {{"tmarrinan", "tmarrinan/omnistereo", false, "its eyes lie square to the point, not to the ray", kIpdParameter},
     like_tmarrinan},
    {{"vray", "V-Ray", false, "its fade from the merge angle is not published", kFading}, like_houdini},
    {{"houdini", "Houdini's VR lens", false, "its smooth curve is not published; smoothstep here", kFading},
     like_houdini},
    {{"renderman", "RenderMan OmnidirectionalStereo", false, "only its manual is public", kIpdParameter},
     like_unmerged},
    {{"redshift", "Redshift Stereo Spherical", false, "only its manual is public", kIpdParameter}, like_unmerged},
};

}  // namespace

std::span<const CameraPreset> camera_presets() {
  static const std::vector<CameraPreset> all = [] {
    std::vector<CameraPreset> list;
    for (const Entry& entry : kEntries) list.push_back(entry.preset);
    return list;
  }();
  return all;
}

const CameraPreset* find_camera_preset(std::string_view name) {
  for (const CameraPreset& preset : camera_presets()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

StereoCamera camera_like(const CameraPreset& preset, const std::map<std::string, std::string>& given) {
  const std::vector<std::string> names = names_of(preset.parameters);
  for (const auto& [name, value] : given) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw std::invalid_argument(fmt::format("{} has no '{}'{}; it has {}", preset.name, name, did_you_mean(name, names),
                                            fmt::join(names, ", ")));
  }
  for (const Entry& entry : kEntries) {
    if (entry.preset.name == preset.name) return entry.make(Values(preset, given));
  }
  throw std::logic_error("a camera preset that is in no table");
}

}  // namespace ods
