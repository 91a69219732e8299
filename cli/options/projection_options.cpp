// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/projection_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/console/console.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/frames.h"
#include "ods/identify/find_input.h"
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

// Numbers of an option that takes one of these counts of them. Throws UsageError.
std::vector<float> parse_count(const std::string& text, std::initializer_list<size_t> counts, const char* usage) {
  std::vector<float> numbers = parse_numbers(text);
  if (std::ranges::find(counts, numbers.size()) != counts.end()) return numbers;
  throw UsageError(fmt::format("{}, not '{}'", usage, text));
}

vec2 parse_direction(const std::string& text) {
  constexpr const char* kUsage = "--lens-direction is PAN,TILT in degrees";
  const std::vector<float> numbers = parse_count(text, {2}, kUsage);
  const bool legal =
      range_of(ods::CameraField::kPan).contains(numbers[0]) && range_of(ods::CameraField::kTilt).contains(numbers[1]);
  if (!legal) throw UsageError(fmt::format("{}, not '{}'", kUsage, text));
  return {numbers[0], numbers[1]};
}

ProjectionSetting parse_face(const std::string& name) {
  for (const Face& face : kFaces) {
    if (face.name != name) continue;
    ProjectionSetting projection = ods::find_projection("perspective")->setting;
    projection.pan = face.pan, projection.tilt = face.tilt;
    return projection;
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

void add_projection_options(Options& options, ProjectionChanges& changes, const std::string& option) {
  options.group("Projection");
  options.custom(
      option, "NAME", option == "--projection" ? "lat-long" : "",
      [&changes, name = option.substr(0, option.find(','))](const std::string& text) {
        changes.named = projection_by_name(name, text);
      },
      fmt::format("projection of each eye's picture: {}", fmt::join(ods::names_of(ods::named_projections()), ", ")));
  options.offer(option, ods::names_of(ods::named_projections()));
  options.custom(
      "--face", "NAME", "", [&](const std::string& text) { changes.face = parse_face(text); },
      "a single cube face: front, right, back, left, up or down");
  options.custom(
      "--range", "LEFT,RIGHT[,BOTTOM,TOP]", "",
      [&](const std::string& text) {
        changes.range = parse_count(text, {2, 4}, "--range is LEFT,RIGHT or LEFT,RIGHT,BOTTOM,TOP in degrees");
      },
      "the part of the sphere that a lat-long or cylinder shows, degrees");
  options.custom(
      "--fov", "DEGREES", "",
      [&](const std::string& text) { changes.fov = parse_count(text, {1}, "--fov is an angle in degrees")[0]; },
      "field of view: of a fisheye edge to edge [180], of a perspective view horizontally [90]");
  options.custom(
      "--lens-polynomial", "K0,K1,K2,K3,K4", "",
      [&](const std::string& text) {
        changes.polynomial = parse_count(text, {5}, "--lens-polynomial is K0,K1,K2,K3,K4");
      },
      "fisheye-polynomial: at R millimetres from the middle of the sensor it looks -(K0 + K1 R + K2 R^2 + K3 R^3 + K4 "
      "R^4) radians off axis, as in Cycles");
  options.custom(
      "--sensor", "WIDTH,HEIGHT", "",
      [&](const std::string& text) {
        const std::vector<float> size = parse_count(text, {2}, "--sensor is WIDTH,HEIGHT in millimetres");
        changes.sensor = vec2(size[0], size[1]);
      },
      "fisheye-polynomial: size of the sensor, millimetres [36,24]");
  options.custom(
      "--lens-direction", "PAN,TILT", "", [&](const std::string& text) { changes.direction = parse_direction(text); },
      fmt::format("where it points ({}), degrees right and up; the eyes stay level", ods::kinds_with(ods::has_lens)));
}

ProjectionSetting changed(ProjectionSetting projection, const ProjectionChanges& changes) {
  if (changes.named) projection = *changes.named;
  if (changes.face) {
    expect(!changes.named || projection.kind == ods::kPerspective, "--face", "perspective, which it implies",
           projection);
    projection = *changes.face;
  }
  if (changes.range) {
    const std::vector<float>& range = *changes.range;
    expect(ods::has_range(projection.kind), "--range", ods::kinds_with(ods::has_range), projection);
    projection.longitude = vec2(range[0], range[1]);
    if (range.size() == 4) projection.latitude = vec2(range[2], range[3]);
  }
  if (changes.fov) {
    expect(ods::has_fov(projection.kind), "--fov", ods::kinds_with(ods::has_fov), projection);
    projection.fov = *changes.fov;
  }
  const bool is_polynomial = projection.kind == ods::kFisheyePolynomial;
  if (changes.polynomial) {
    expect(is_polynomial, "--lens-polynomial", "fisheye-polynomial", projection);
    std::ranges::copy(*changes.polynomial, projection.polynomial.begin());
  }
  if (changes.sensor) {
    expect(is_polynomial, "--sensor", "fisheye-polynomial", projection);
    projection.sensor = *changes.sensor;
  }
  if (changes.direction) {
    expect(ods::has_lens(projection.kind), "--lens-direction", ods::kinds_with(ods::has_lens), projection);
    projection.pan = changes.direction->x, projection.tilt = changes.direction->y;
  }
  return projection;
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
      "the image circle of its fisheye, if it does not touch the edges: middle and radius in pixels of the eye as "
      "players show it; six numbers: the left eye's and the right one's");
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

void add_input_argument(Options& options, const ValueKind& kind, std::vector<std::string>& files,
                        const std::string& text) {
  options.arguments(kind, files,
                    text + "; two files, or %V in the name: the left eye and the right one; six: the faces of a cube");
}

std::string joined_input(const std::vector<std::string>& files, const ods::FormatHint& known) {
  if (files.empty()) throw UsageError("no input file: name a picture or a video");
  const bool alone = known.one_eye || known.layout || known.projection || known.camera || !known.lenses.empty();
  ods::FoundInput found = ods::find_input(files, alone);
  for (const std::string& each : found.notes) note(with_options(each));
  return std::move(found.path);
}

ods::MediaFile open_input(const std::string& path, const ods::MediaOptions& options) {
  ods::MediaFile media = ods::open_media(path, options);
  refuse_unlikely(media);
  for (const std::string& each : media.notes) note(fmt::format("'{}' is {}", media.path, each));
  return media;
}
