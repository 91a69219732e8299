// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/projection_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/console/console.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/frames.h"
#include "ods/identify/identify.h"
#include "ods/video/container/video_file.h"
#include "ods/video/footage.h"

using ods::NamedProjection, ods::ProjectionSetting, ods::vec2;

namespace {

struct Face {
  std::string_view name;
  float pan;
  float tilt;
};
constexpr Face kFaces[] = {{"front", 0.0f, 0.0f},  {"right", 90.0f, 0.0f}, {"back", 180.0f, 0.0f},
                           {"left", -90.0f, 0.0f}, {"up", 0.0f, 90.0f},    {"down", 0.0f, -90.0f}};

// An option that does not apply to a projection would otherwise be ignored silently.
void expect(bool useful, const char* option, const std::string& owners, const ProjectionSetting& projection) {
  if (useful) return;
  throw UsageError(
      fmt::format("{} is for {}, not for the projection {}", option, owners, ods::projection_name(projection)));
}

// LON0,LON1[,LAT0,LAT1]
void parse_range(const std::string& text, ProjectionSetting& projection) {
  expect(ods::has_range(projection.kind), "--range", ods::kinds_with(ods::has_range), projection);
  const std::vector<float> numbers = parse_numbers(text);
  if (numbers.size() != 2 && numbers.size() != 4) {
    throw UsageError(fmt::format("--range is LEFT,RIGHT or LEFT,RIGHT,BOTTOM,TOP in degrees, not '{}'", text));
  }
  projection.longitude = vec2(numbers[0], numbers[1]);
  if (numbers.size() == 4) projection.latitude = vec2(numbers[2], numbers[3]);
}

void parse_look(const std::string& text, ProjectionSetting& projection) {
  expect(ods::has_lens(projection.kind), "--lens-direction", ods::kinds_with(ods::has_lens), projection);
  const std::vector<float> numbers = parse_numbers(text);
  const bool legal = numbers.size() == 2 && range_of(ods::CameraField::kPan).contains(numbers[0]) &&
                     range_of(ods::CameraField::kTilt).contains(numbers[1]);
  if (!legal) throw UsageError(fmt::format("--lens-direction is PAN,TILT in degrees, not '{}'", text));
  projection.pan = numbers[0], projection.tilt = numbers[1];
}

void parse_fov(const std::string& text, ProjectionSetting& projection) {
  expect(ods::has_fov(projection.kind), "--fov", ods::kinds_with(ods::has_fov), projection);
  const std::vector<float> numbers = parse_numbers(text);
  if (numbers.size() != 1) throw UsageError(fmt::format("--fov is an angle in degrees, not '{}'", text));
  projection.fov = numbers[0];
}

void parse_sensor(const std::string& text, ProjectionSetting& projection) {
  expect(projection.kind == ods::kFisheyePolynomial, "--sensor", "fisheye-polynomial", projection);
  const std::vector<float> numbers = parse_numbers(text);
  if (numbers.size() != 2) throw UsageError(fmt::format("--sensor is WIDTH,HEIGHT in millimetres, not '{}'", text));
  projection.sensor = vec2(numbers[0], numbers[1]);
}

void parse_polynomial(const std::string& text, ProjectionSetting& projection) {
  expect(projection.kind == ods::kFisheyePolynomial, "--lens-polynomial", "fisheye-polynomial", projection);
  const std::vector<float> numbers = parse_numbers(text);
  if (numbers.size() != projection.polynomial.size()) {
    throw UsageError(fmt::format("--lens-polynomial is K0,K1,K2,K3,K4, not '{}'", text));
  }
  std::copy(numbers.begin(), numbers.end(), projection.polynomial.begin());
}

void parse_face(const std::string& name, bool has_other, ProjectionSetting& projection) {
  expect(!has_other || projection.kind == ods::kPerspective, "--face", "perspective, which it implies", projection);
  for (const Face& face : kFaces) {
    if (face.name != name) continue;
    projection = ods::find_projection("perspective")->setting;
    projection.pan = face.pan, projection.tilt = face.tilt;
    return;
  }
  throw UsageError(fmt::format("--face is front, right, back, left, up or down, not '{}'", name));
}

}  // namespace

ProjectionSetting projection_by_name(const std::string& option, const std::string& name) {
  if (const NamedProjection* named = ods::find_projection(name)) return named->setting;
  const std::vector<std::string> names = ods::names_of(ods::named_projections());
  throw UsageError(
      fmt::format("{} is one of {}, not '{}'{}", option, fmt::join(names, ", "), name, ods::did_you_mean(name, names)));
}

void add_projection_options(Options& options, ProjectionSetting& projection, const std::string& option,
                            const std::function<bool()>& is_open) {
  options.group("Projection");
  const auto is_named = std::make_shared<bool>(false);
  const auto add = [&](const char* name, const char* unit, const auto& parse, const std::string& text) {
    const auto set = [&projection, is_named, is_open, parse](const std::string& word) {
      if (*is_named || !is_open || !is_open()) parse(word, projection);
    };
    options.custom(name, unit, "", set, text);
  };
  options.custom(
      option, "NAME", option == "--projection" ? "lat-long" : "",
      [&projection, option, is_named](const std::string& text) {
        projection = projection_by_name(option, text);
        *is_named = true;
      },
      fmt::format("projection of each eye's picture: {}", fmt::join(ods::names_of(ods::named_projections()), ", ")));
  options.offer(option, ods::names_of(ods::named_projections()));
  options.custom(
      "--face", "NAME", "",
      [&projection, is_named](const std::string& text) { parse_face(text, *is_named, projection); },
      "a single cube face: front, right, back, left, up or down");
  add("--range", "LEFT,RIGHT[,BOTTOM,TOP]", parse_range,
      "the part of the sphere that a lat-long or cylinder shows, degrees");
  add("--fov", "DEGREES", parse_fov,
      "field of view: of a fisheye edge to edge [180], of a perspective view horizontally [90]");
  add("--lens-polynomial", "K0,K1,K2,K3,K4", parse_polynomial,
      "fisheye-polynomial: at R millimetres from the middle of the sensor it looks -(K0 + K1 R + K2 R^2 + K3 R^3 + K4 "
      "R^4) radians off axis, as in Cycles");
  add("--sensor", "WIDTH,HEIGHT", parse_sensor, "fisheye-polynomial: size of the sensor, millimetres [36,24]");
  add("--lens-direction", "PAN,TILT", parse_look,
      fmt::format("where it points ({}), degrees right and up; the eyes stay level", ods::kinds_with(ods::has_lens)));
}

// One circle for both eyes, or one for each.
static void parse_circles(const std::string& text, ods::FormatHint& known) {
  const std::vector<float> numbers = parse_numbers(text);
  known.lenses.clear();
  for (size_t i = 0; i + 2 < numbers.size(); i += 3) {
    ods::FisheyeLens& lens = known.lenses.emplace_back();
    lens.center = vec2(numbers[i], numbers[i + 1]), lens.radius = numbers[i + 2], lens.fov = 0.0f;
  }
  if ((numbers.size() == 3 || numbers.size() == 6) && known.lenses[0].radius > 0.0f) return;
  throw UsageError(
      fmt::format("--circle is X,Y,R, the middle and the radius of the image circle in pixels of the eye's picture, or "
                  "X,Y,R,X,Y,R for the left eye and the right one, not '{}'",
                  text));
}

void add_lens_options(Options& options, ods::FormatHint& known) {
  options.flag("--front-and-back", known.front_and_back,
               "its halves are fisheyes that look ahead and back (Gear 360, Theta, Insta360): one eye");
  options.custom(
      "--circle", "X,Y,R[,X,Y,R]", "", [&known](const std::string& text) { parse_circles(text, known); },
      "the image circle of its fisheye, if it does not touch the edges: middle and radius in pixels of the eye's "
      "picture; six numbers: the left eye's and the right one's");
}

void finish_lens_options(ods::FormatHint& known) {
  constexpr float kUsualFov = 195.0f;  // of cameras that look ahead and back
  if (known.lenses.empty() && !known.front_and_back) return;
  if (known.front_and_back && !known.layout) known.layout = ods::Layout::kSideBySide;
  if (!known.projection || !ods::is_fisheye(known.projection->kind)) {
    known.projection = ods::find_projection("fisheye")->setting;
    if (known.front_and_back) known.projection->fov = kUsualFov;
  }
  for (ods::FisheyeLens& lens : known.lenses) {
    lens.kind = known.projection->kind;
    if (lens.fov == 0.0f) lens.fov = known.projection->fov;
  }
}

void finish_projection(ProjectionSetting& projection, int width, int& height) {
  if (height > 0) projection.aspect = static_cast<float>(width) / static_cast<float>(height);
  const std::string fault = ods::projection_fault(projection);
  if (!fault.empty()) throw UsageError(fault);
  if (ods::is_full_lat_long(projection) && height == 0 && width % 2 != 0) {
    throw UsageError(fmt::format("--width is even, not {}: a lat-long picture is twice as wide as high", width));
  }
  const int step = ods::width_step(projection);
  if (width % step != 0) {
    throw UsageError(fmt::format("--width is a multiple of {} for {}, whose faces are {} abreast: {}, not {}", step,
                                 ods::projection_name(projection), step, width - width % step + step, width));
  }
  if (height == 0) height = ods::natural_height(projection, width);
}

ods::FormatHint identified_input(const std::string& path, const ods::FormatHint& known) {
  std::string first = path;
  const ods::FootageKind kind = ods::footage_kind(path);
  if (kind == ods::FootageKind::kFrames) {
    const ods::FrameNames names = *ods::frame_names(path);
    const std::vector<int> frames = ods::frames_on_disk(names);
    if (frames.empty()) return known;
    first = names.path(frames.front());
  }
  if (kind == ods::FootageKind::kVideo && !ods::is_video(path)) return known;
  std::vector<std::string> doubts;
  const ods::FormatHint format = ods::identified(first, known, doubts);
  for (const std::string& doubt : doubts) note(fmt::format("'{}' is {}", first, doubt));
  return format;
}
