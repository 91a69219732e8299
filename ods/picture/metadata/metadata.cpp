// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>

#include "ods/base/decimal.h"
#include "ods/camera/camera_fields.h"
#include "ods/image/format/pixel_place.h"
#include "ods/image/format/xmp.h"

namespace ods {

// --- our own attributes ----------------------------------------------------------------------------------------------

constexpr const char* kMergeCurve = "ods:mergeCurve";
constexpr int kMaxCurveRows = 4096;

// The attribute of a field's number i.
static std::string attribute_of(const CameraFieldRow& row, size_t i) {
  return row.attribute.ends_with('#') ? fmt::format("{}{}", row.attribute.substr(0, row.attribute.size() - 1), i)
                                      : std::string(row.attribute);
}

// Writes a map that is the same all around, such as a merge by depth, as a curve: "4x180:" and a number per row, from
// the top. Empty for other maps.
static std::string text_of_curve(const Image& map) {
  if (map.height > kMaxCurveRows || !is_same_around(map)) return "";
  std::string text = fmt::format("{}x{}:", map.width, map.height);
  for (int y = 0; y < map.height; y++) text += fmt::format(" {}", decimal(*map.at(0, y)));
  return text;
}

// Returns null if the text is not a curve.
static std::shared_ptr<const Image> curve_of_text(const std::string& text) {
  int width = 0, height = 0, used = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d:%n", &width, &height, &used) != 2 || used == 0) return nullptr;
  if (width < 1 || width > kMaxCurveRows || height < 1 || height > kMaxCurveRows) return nullptr;
  auto map = std::make_shared<Image>(width, height, 1);
  const char *at = text.data() + used, *const end = text.data() + text.size();
  for (int y = 0; y < height; y++) {
    float value = 0.0f;
    if (at == end || *at++ != ' ') return nullptr;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !(value >= 0.0f && value <= 1.0f)) return nullptr;
    std::fill_n(map->at(0, y), width, value);
    at = next;
  }
  return at == end ? map : nullptr;
}

static bool merges_by_map(const StereoCamera& camera) {
  return camera.top.mode == kMergeMap || camera.bottom.mode == kMergeMap;
}

void add_camera(std::vector<Attribute>& attributes, const StereoCamera& camera) {
  attributes.push_back({"ods:projection", std::string(projection_name(camera.projection))});
  attributes.push_back({"ods:depthType", std::string("ray")});
  for (const CameraModeRow& row : camera_modes()) {
    if (row.matters(camera)) attributes.push_back({std::string(row.attribute), std::string(mode_of(camera, row))});
  }
  std::map<std::string, std::vector<float>> numbers;
  for (const CameraFieldRow& row : camera_fields()) {
    if (!row.matters(camera)) continue;
    const std::vector<float> values = values_of(camera, row);
    for (size_t i = 0; i < values.size(); i++) numbers[attribute_of(row, i)].push_back(values[i]);
  }
  for (const auto& [name, values] : numbers) {
    if (values.size() == 1) attributes.push_back({name, values[0]});
    if (values.size() > 1) attributes.push_back({name, values});
  }
  if (camera.mirrored) attributes.push_back({"ods:mirrored", 1});
  if (camera.head_tilt_map) attributes.push_back({"ods:headTilt", std::string("map")});
  const std::string curve = merges_by_map(camera) ? text_of_curve(*camera.merge_map) : "";
  if (!curve.empty()) attributes.push_back({kMergeCurve, curve});
}

namespace {

// Reads a file's attributes one by one and remembers the first that is invalid.
class AttributeReader {
 public:
  explicit AttributeReader(const FileInfo& info) : info_(info) {}

  std::optional<std::string> word(const std::string& name) const {
    const auto found = info_.text.find(name);
    return found == info_.text.end() ? std::nullopt : std::optional(found->second);
  }
  // Empty if the file does not have the attribute.
  std::vector<float> numbers(const std::string& name) const {
    const auto found = info_.numbers.find(name);
    return found == info_.numbers.end() ? std::vector<float>() : found->second;
  }

  void refuse(const std::string& name) {
    if (bad_.empty()) bad_ = name;
  }
  const std::string& bad() const { return bad_; }

 private:
  const FileInfo& info_;
  std::string bad_;
};

void read_modes(AttributeReader& in, StereoCamera& camera) {
  for (const CameraModeRow& row : camera_modes()) {
    const std::string name(row.attribute);
    const std::optional<std::string> word = in.word(name);
    if (!word) continue;
    const auto named = std::ranges::find(row.names, *word, &NameRow<int>::name);
    if (named == row.names.end()) {
      in.refuse(name);
    } else {
      row.value(camera) = named->member;
    }
  }
}

void read_numbers(AttributeReader& in, StereoCamera& camera) {
  std::map<std::string, std::vector<std::pair<float*, FieldRange>>> wanted;
  for (const CameraFieldRow& row : camera_fields()) {
    const std::vector<float*> numbers = row.numbers(camera);
    for (size_t i = 0; i < numbers.size(); i++) wanted[attribute_of(row, i)].emplace_back(numbers[i], row.range);
  }
  for (const auto& [name, numbers] : wanted) {
    const std::vector<float> found = in.numbers(name);
    if (found.empty()) continue;
    if (found.size() != numbers.size()) in.refuse(name);
    for (size_t i = 0; i < std::min(found.size(), numbers.size()); i++) {
      if (!numbers[i].second.contains(found[i])) in.refuse(name);
      *numbers[i].first = found[i];
    }
  }
}

// Maps that vary around are only in sidecars.
void read_maps(AttributeReader& in, StereoCamera& camera, const StereoCamera* maps,
               std::vector<std::string>& warnings) {
  if (merges_by_map(camera)) {
    const std::optional<std::string> curve = in.word(kMergeCurve);
    if (curve) camera.merge_map = curve_of_text(*curve);
    if (curve && !camera.merge_map) return in.refuse(kMergeCurve);
    if (!curve && maps) camera.merge_map = maps->merge_map;
  }
  if (merges_by_map(camera) && !camera.merge_map) {
    for (PoleMergeSetting* merge : {&camera.top, &camera.bottom}) {
      if (merge->mode == kMergeMap) merge->mode = kMergeNone;
    }
    warnings.push_back("its merge map is in a sidecar that is missing: using no pole merge");
  }
  const std::optional<std::string> tilt = in.word("ods:headTilt");
  if (tilt && *tilt != "map") return in.refuse("ods:headTilt");
  if (tilt && maps) camera.head_tilt_map = maps->head_tilt_map;
  if (tilt && !camera.head_tilt_map)
    warnings.push_back("its head-tilt map is in a sidecar that is missing: using a level head");
}

}  // namespace

std::optional<StereoCamera> camera_of(const FileInfo& info, std::vector<std::string>& warnings,
                                      const StereoCamera* maps) {
  AttributeReader in(info);
  const std::optional<std::string> projection = in.word("ods:projection");
  if (!projection) return std::nullopt;
  StereoCamera camera;
  if (const NamedProjection* named = find_projection(*projection)) {
    camera.projection = named->setting;
  } else {
    in.refuse("ods:projection");
  }
  if (!in.numbers("ods:axis").empty()) camera.axis = vec3(0.0f);
  read_modes(in, camera);
  read_numbers(in, camera);
  camera.mirrored = !in.numbers("ods:mirrored").empty();
  read_maps(in, camera, maps, warnings);
  const std::string fault = in.bad().empty() ? camera_fault(camera) : "";
  if (in.bad().empty() && fault.empty()) return camera;
  const std::string what = fault.empty() ? fmt::format("{} is invalid", in.bad()) : "camera is impossible: " + fault;
  warnings.push_back(fmt::format("its {}: ignoring its camera metadata", what));
  return std::nullopt;
}

bool lacks_merge_map(const FileInfo& info, const StereoCamera& camera) {
  if (camera.merge_map) return false;
  return std::ranges::any_of(camera_modes(), [&](const CameraModeRow& row) {
    const auto word = info.text.find(std::string(row.attribute));
    return row.attribute.starts_with("ods:poleMerge") && word != info.text.end() &&
           word->second == merge_name(kMergeMap);
  });
}

// --- GPano -----------------------------------------------------------------------------------------------------------

// Heading 0..360, pitch -90..90, roll -180..180; our -Z is its north.
void add_gpano(std::vector<Attribute>& attributes, const StereoCamera& camera, Extent size) {
  float yaw = camera.yaw, pitch = std::remainder(camera.pitch, 360.0f), roll = camera.roll;
  if (std::abs(pitch) > 90.0f) {  // over the pole: the same orientation, described from the other side
    pitch = std::copysign(180.0f, pitch) - pitch;
    yaw += 180.0f;
    roll += 180.0f;
  }
  const float heading = std::remainder(yaw, 360.0f);
  attributes.push_back({"GPano:ProjectionType", std::string("equirectangular")});
  attributes.push_back({"GPano:UsePanoramaViewer", std::string("True")});
  const vec2 longitude = camera.projection.longitude, latitude = camera.projection.latitude;
  const float per_degree_x = static_cast<float>(size.width) / (longitude.y - longitude.x);
  const float per_degree_y = static_cast<float>(size.height) / (latitude.y - latitude.x);
  const auto pixels = [](float count) { return static_cast<int>(std::lround(count)); };
  attributes.push_back({"GPano:CroppedAreaImageWidthPixels", size.width});
  attributes.push_back({"GPano:CroppedAreaImageHeightPixels", size.height});
  attributes.push_back({"GPano:FullPanoWidthPixels", pixels(360.0f * per_degree_x)});
  attributes.push_back({"GPano:FullPanoHeightPixels", pixels(180.0f * per_degree_y)});
  attributes.push_back({"GPano:CroppedAreaLeftPixels", pixels((longitude.x + 180.0f) * per_degree_x)});
  attributes.push_back({"GPano:CroppedAreaTopPixels", pixels((90.0f - latitude.y) * per_degree_y)});
  attributes.push_back({"GPano:PoseHeadingDegrees", heading < 0.0f ? heading + 360.0f : heading + 0.0f});
  attributes.push_back({"GPano:PosePitchDegrees", pitch + 0.0f});
  attributes.push_back({"GPano:PoseRollDegrees", std::remainder(roll, 360.0f) + 0.0f});
  attributes.push_back({"GPano:StitchingSoftware", std::string("Omnistereo " ODS_VERSION)});
}

bool fits_gpano(const ProjectionSetting& projection) {
  return projection.kind == kLatLong && projection.longitude.x >= -180.0f && projection.longitude.y <= 180.0f;
}

static std::string gpano_property(const std::string& xmp, const std::string& name) {
  return std::string(xmp_property(xmp, "GPano:" + name));
}

static std::optional<double> gpano_number(const std::string& xmp, const std::string& name) {
  const std::string text = gpano_property(xmp, name);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && std::abs(value) <= 1e6 ? std::optional(value) : std::nullopt;
}

void read_gpano_pose(const std::string& xmp, StereoCamera& camera) {
  const auto angle = [&](const char* name) { return static_cast<float>(gpano_number(xmp, name).value_or(0.0)); };
  camera.yaw = angle("PoseHeadingDegrees");
  camera.pitch = angle("PosePitchDegrees");
  camera.roll = angle("PoseRollDegrees");
}

std::optional<StereoCamera> gpano_camera(const std::string& xmp) {
  const std::string type = gpano_property(xmp, "ProjectionType");
  if (!type.empty() && type != "equirectangular") return std::nullopt;
  StereoCamera camera;
  const auto number = [&](const char* name) { return gpano_number(xmp, name); };
  // The crop's bounds, in pixels of the whole sphere; the whole sphere if absent.
  const auto width = number("FullPanoWidthPixels"), height = number("FullPanoHeightPixels");
  const auto left = number("CroppedAreaLeftPixels"), across = number("CroppedAreaImageWidthPixels");
  const auto top = number("CroppedAreaTopPixels"), down = number("CroppedAreaImageHeightPixels");
  const bool has_crop = width && left && across && *width > 0.0 && height && top && down && *height > 0.0;
  if (type.empty() && !has_crop) return std::nullopt;
  if (width && left && across && *width > 0.0) {
    camera.projection.longitude = glm::dvec2(*left, *left + *across) * 360.0 / *width - 180.0;
  }
  if (height && top && down && *height > 0.0) {
    camera.projection.latitude = 90.0 - glm::dvec2(*top + *down, *top) * 180.0 / *height;
  }
  if (!projection_fault(camera.projection).empty()) return std::nullopt;
  read_gpano_pose(xmp, camera);
  return camera;
}

std::optional<StereoCamera> placed_camera(const FileInfo& info) {
  const auto found = info.numbers.find(std::string(kWholeArea));
  if (found == info.numbers.end()) return std::nullopt;
  const glm::dvec2 corner(found->second[0], found->second[1]), whole(found->second[2], found->second[3]);
  if (whole.x != 2.0 * whole.y) return std::nullopt;
  StereoCamera camera;
  camera.projection.longitude = glm::dvec2(corner.x, corner.x + info.width) * 360.0 / whole.x - 180.0;
  camera.projection.latitude = 90.0 - glm::dvec2(corner.y + info.height, corner.y) * 180.0 / whole.y;
  return projection_fault(camera.projection).empty() ? std::optional(camera) : std::nullopt;
}

}  // namespace ods
