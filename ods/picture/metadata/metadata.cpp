// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "ods/camera/camera_fields.h"
#include "ods/image/format/xmp.h"

namespace ods {

// --- our own attributes ----------------------------------------------------------------------------------------------

static void add_merge(std::vector<Attribute>& attributes, const std::string& name, const PoleMergeSetting& merge) {
  attributes.push_back({name, std::string(merge_name(merge.mode))});
  if (merge.mode == kMergeNone) return;
  attributes.push_back({name + "Start", merge.start});
  attributes.push_back({name + "End", merge.end});
  attributes.push_back({name + "Exponent", merge.exponent});
}

static void add_projection(std::vector<Attribute>& attributes, const ProjectionSetting& projection) {
  const auto pair = [&](const char* name, float a, float b) { attributes.push_back({name, std::vector<float>{a, b}}); };
  attributes.push_back({"ods:projection", std::string(projection_name(projection))});
  if (has_range(projection.kind) && !is_full_lat_long(projection)) {
    pair("ods:longitude", projection.longitude.x, projection.longitude.y);
    pair("ods:latitude", projection.latitude.x, projection.latitude.y);
  }
  if (has_fov(projection.kind)) attributes.push_back({"ods:fov", projection.fov});
  if (has_lens(projection.kind)) pair("ods:look", projection.pan, projection.tilt);
  if (projection.kind == kPerspective) attributes.push_back({"ods:aspect", projection.aspect});
  if (projection.kind == kFisheyePolynomial) {
    pair("ods:sensor", projection.sensor.x, projection.sensor.y);
    for (size_t i = 0; i < projection.polynomial.size(); i++) {
      attributes.push_back({fmt::format("ods:lensK{}", i), projection.polynomial[i]});
    }
  }
}

// Rarely used camera fields are written only if set.
static void add_extras(std::vector<Attribute>& attributes, const StereoCamera& camera) {
  if (camera.convergence != kParallel) {
    attributes.push_back({"ods:convergence", std::string(convergence_name(camera.convergence))});
    attributes.push_back({"ods:convergenceDistance", camera.convergence_distance});
  }
  if (camera.neck != 0.0f) attributes.push_back({"ods:neck", camera.neck});
  if (camera.axis)
    attributes.push_back({"ods:axis", std::vector<float>{camera.axis->x, camera.axis->y, camera.axis->z}});
  if (camera.lens_radius > 0.0f) {
    attributes.push_back({"ods:lens", std::vector<float>{camera.lens_radius, camera.focus_distance}});
  }
  if (camera.mirrored) attributes.push_back({"ods:mirrored", 1});
  if (camera.head_tilt_map) attributes.push_back({"ods:headTilt", std::string("map")});
}

void add_camera(std::vector<Attribute>& attributes, const StereoCamera& camera) {
  add_projection(attributes, camera.projection);
  attributes.push_back({"ods:depthType", std::string("ray")});
  attributes.push_back({"ods:ipd", camera.ipd});
  attributes.push_back({"ods:position", std::vector<float>{camera.position.x, camera.position.y, camera.position.z}});
  attributes.push_back({"ods:yaw", camera.yaw});
  attributes.push_back({"ods:pitch", camera.pitch});
  attributes.push_back({"ods:roll", camera.roll});
  add_merge(attributes, "ods:poleMergeTop", camera.top);
  add_merge(attributes, "ods:poleMergeBottom", camera.bottom);
  add_extras(attributes, camera);
}

namespace {

// Reads a file's attributes one by one and remembers the first that is invalid.
class AttributeReader {
 public:
  explicit AttributeReader(const FileInfo& info) : info_(info) {}

  struct Number {
    float* value;
    CameraField field;
  };
  void numbers(const std::string& name, std::initializer_list<Number> numbers) {
    const auto found = info_.numbers.find(name);
    if (found == info_.numbers.end()) return;
    if (found->second.size() != numbers.size()) return refuse(name);
    const float* from = found->second.data();
    for (const Number& number : numbers) {
      if (!range_of(number.field).contains(*from)) return refuse(name);
      *number.value = *from++;
    }
  }
  void number(const std::string& name, float& value, CameraField field) { numbers(name, {{&value, field}}); }
  bool has(const std::string& name) const { return info_.numbers.contains(name); }

  std::optional<std::string> word(const std::string& name) const {
    const auto found = info_.text.find(name);
    return found == info_.text.end() ? std::nullopt : std::optional(found->second);
  }

  void refuse(const std::string& name) {
    if (bad_.empty()) bad_ = name;
  }
  const std::string& bad() const { return bad_; }

 private:
  const FileInfo& info_;
  std::string bad_;
};

}  // namespace

static void read_merge(AttributeReader& in, const std::string& name, PoleMergeSetting& merge,
                       std::vector<std::string>& warnings) {
  const std::optional<std::string> word = in.word(name);
  if (!word) return;
  const std::optional<int> mode = merge_of(*word);
  if (!mode) return in.refuse(name);
  in.number(name + "Start", merge.start, CameraField::kMergeStart);
  in.number(name + "End", merge.end, CameraField::kMergeEnd);
  in.number(name + "Exponent", merge.exponent, CameraField::kMergeExponent);
  if (merge.start >= merge.end) in.refuse(name + "Start");
  merge.mode = *mode;
  if (merge.mode != kMergeMap) return;
  merge.mode = kMergeNone;
  warnings.push_back("its merge map is in a sidecar that is missing: using no pole merge");
}

static void read_projection(AttributeReader& in, const std::string& name, ProjectionSetting& setting) {
  const NamedProjection* named = find_projection(name);
  if (!named) return in.refuse("ods:projection");
  setting = named->setting;
  in.numbers("ods:longitude",
             {{&setting.longitude.x, CameraField::kLongitude}, {&setting.longitude.y, CameraField::kLongitude}});
  in.numbers("ods:latitude",
             {{&setting.latitude.x, CameraField::kLatitude}, {&setting.latitude.y, CameraField::kLatitude}});
  in.number("ods:fov", setting.fov, CameraField::kFov);
  in.number("ods:aspect", setting.aspect, CameraField::kAspect);
  in.numbers("ods:look", {{&setting.pan, CameraField::kPan}, {&setting.tilt, CameraField::kTilt}});
  in.numbers("ods:sensor", {{&setting.sensor.x, CameraField::kSensor}, {&setting.sensor.y, CameraField::kSensor}});
  for (size_t i = 0; i < setting.polynomial.size(); i++) {
    in.number(fmt::format("ods:lensK{}", i), setting.polynomial[i], CameraField::kPolynomial);
  }
  if (!projection_fault(setting).empty()) in.refuse("ods:projection");
}

static void read_extras(AttributeReader& in, StereoCamera& camera, std::vector<std::string>& warnings) {
  if (const auto word = in.word("ods:convergence")) {
    const std::optional<int> convergence = find_in(kConvergenceTable, *word);
    if (convergence) camera.convergence = *convergence;
    if (!convergence) in.refuse("ods:convergence");
  }
  in.number("ods:convergenceDistance", camera.convergence_distance, CameraField::kConvergenceDistance);
  in.number("ods:neck", camera.neck, CameraField::kNeck);
  if (in.has("ods:axis")) {
    vec3 axis(0.0f);
    in.numbers("ods:axis",
               {{&axis.x, CameraField::kAxis}, {&axis.y, CameraField::kAxis}, {&axis.z, CameraField::kAxis}});
    if (length(axis) > 1e-6f) camera.axis = axis;
    if (!camera.axis) in.refuse("ods:axis");
  }
  in.numbers("ods:lens",
             {{&camera.lens_radius, CameraField::kLensRadius}, {&camera.focus_distance, CameraField::kFocusDistance}});
  camera.mirrored = in.has("ods:mirrored");
  const std::optional<std::string> tilt = in.word("ods:headTilt");
  if (tilt && *tilt != "map") return in.refuse("ods:headTilt");
  if (tilt) warnings.push_back("its head-tilt map is in a sidecar that is missing: using a level head");
}

std::optional<StereoCamera> camera_of(const FileInfo& info, std::vector<std::string>& warnings) {
  AttributeReader in(info);
  const std::optional<std::string> projection = in.word("ods:projection");
  if (!projection) return std::nullopt;
  StereoCamera camera;
  read_projection(in, *projection, camera.projection);
  in.number("ods:ipd", camera.ipd, CameraField::kIpd);
  in.numbers("ods:position", {{&camera.position.x, CameraField::kPosition},
                              {&camera.position.y, CameraField::kPosition},
                              {&camera.position.z, CameraField::kPosition}});
  in.number("ods:yaw", camera.yaw, CameraField::kYaw);
  in.number("ods:pitch", camera.pitch, CameraField::kPitch);
  in.number("ods:roll", camera.roll, CameraField::kRoll);
  read_merge(in, "ods:poleMergeTop", camera.top, warnings);
  read_merge(in, "ods:poleMergeBottom", camera.bottom, warnings);
  read_extras(in, camera, warnings);
  if (in.bad().empty()) return camera;
  warnings.push_back(fmt::format("its {} is invalid: ignoring its camera metadata", in.bad()));
  return std::nullopt;
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
  attributes.push_back({"GPano:PoseHeadingDegrees", heading < 0.0f ? heading + 360.0f : heading});
  attributes.push_back({"GPano:PosePitchDegrees", pitch});
  attributes.push_back({"GPano:PoseRollDegrees", std::remainder(roll, 360.0f)});
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

}  // namespace ods
