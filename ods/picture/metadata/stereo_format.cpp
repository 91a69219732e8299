// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/stereo_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/camera/file_names.h"
#include "ods/camera/odd_halves.h"
#include "ods/files/file_input.h"
#include "ods/image/format/pixel_place.h"
#include "ods/image/format/stereo_jpeg.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/name_words.h"
#include "ods/picture/metadata/phone_window.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/metadata/vr_photo.h"

namespace ods {

// --- the name --------------------------------------------------------------------------------------------------------

std::string name_end(const ProjectionSetting& projection, Layout layout) {
  const bool is_whole = is_full_lat_long(projection) || is_cube(projection.kind);
  const char* const angle = is_vr180(projection) ? "_180" : is_whole ? "_360" : "";
  const EyeArrangement eyes = arrangement_of(layout);
  std::string word;
  if (eyes.how == EyePacking::kStacked && !eyes.squeezed) word = eyes.right_first ? "_BT" : "_TB";
  if (eyes.how == EyePacking::kBeside && !eyes.squeezed) word = eyes.right_first ? "_RL" : "_LR";
  if (layout == Layout::kSeparate) word = "_%V";
  return angle + word + (layout == Layout::kMultiview ? ".exr" : ".png");
}

std::string renamed(const std::string& path, const std::string& words) {
  const std::filesystem::path file(path);
  std::string name = file.stem().native();
  const NameWords old = read_name(path);
  for (const std::string& word : {old.layout_token, old.projection_token}) {
    if (!word.empty()) name.erase(name.rfind(word), word.size());
  }
  return (file.parent_path() / (name + words + file.extension().native())).native();
}

// --- the aspect ratio ------------------------------------------------------------------------------------------------

static bool has_shape(const ProjectionSetting& setting, Extent eye) {
  return eye.width % width_step(setting) == 0 && natural_height(setting, eye.width) == eye.height;
}

bool is_told_by_shape(const ProjectionSetting& setting, Extent eye) {
  return setting.kind != kPerspective && has_shape(setting, eye);
}

// The projections that an aspect ratio alone identifies. 3:2 does not identify a cube, because most cameras' photos
// have it.
static std::vector<const NamedProjection*> shapes() {
  return {find_projection("lat-long"), find_projection("cube-6x1"), find_projection("cube-1x6")};
}

static std::optional<LayoutGuess> layout_of_shape(Extent file, const std::optional<ProjectionSetting>& known) {
  std::vector<ProjectionSetting> settings;
  if (known) settings.push_back(*known);
  for (const NamedProjection* shape : shapes()) {
    if (!known) settings.push_back(shape->setting);
  }
  for (const ProjectionSetting& setting : settings) {
    const std::string_view name = projection_name(setting);
    if (has_shape(setting, file)) {
      return LayoutGuess{{}, FormatSource::kShape, fmt::format("it has the shape of one eye, {}", name)};
    }
    for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
      const std::optional<Extent> eye = unpacked_size(layout, file);
      if (eye && has_shape(setting, *eye)) {
        return LayoutGuess{layout, FormatSource::kShape, fmt::format("it has the shape of two eyes, {}", name)};
      }
    }
  }
  return std::nullopt;
}

// Returns whether the file has a colour layer of that view; Blender's layers have names.
static bool has_view(const FileInfo& info, const std::string& view) {
  return std::ranges::any_of(info.channels, [&](const std::string& channel) {
    return channel == view + ".R" || channel.ends_with(".Combined." + view + ".R");
  });
}

// The layout in ods:layout, or the eye that it specifies.
static std::optional<LayoutGuess> declared_layout(const FileInfo& info) {
  const auto said = info.text.find("ods:layout");
  if (said == info.text.end()) return std::nullopt;
  LayoutGuess guess{layout_of(said->second), FormatSource::kOwnMetadata, "according to the file"};
  for (int eye : {kLeft, kRight, kMono}) {
    if (said->second == eye_name(eye)) return guess;
  }
  return guess.layout ? std::optional(guess) : std::nullopt;
}

bool is_guess(const LayoutGuess& guess) {
  return guess.source > FormatSource::kOtherMetadata;
}

// --- all sources combined ------------------------------------------------------------------------------------------

bool belongs_to(const Sidecar& sidecar, const FileInfo& info) {
  const int count = static_cast<int>(sidecar.eyes.size());
  if (count == 2 && sidecar.layout == Layout::kMultiview && !has_view(info, "right")) return false;
  if (sidecar.eye.width == 0) return true;
  const Extent size = packed_size(sidecar.layout, squeezed_eye(sidecar.layout, sidecar.eye, count), count);
  return size.width == info.width && size.height == info.height;
}

static std::optional<Sidecar> find_sidecar(const FileInfo& info, const std::string& path, const FormatHint& known,
                                           std::vector<std::string>& warnings) {
  const std::string beside = sidecar_path(path);
  std::error_code ignored;
  if (known.camera || !std::filesystem::exists(beside, ignored)) return std::nullopt;
  try {
    std::optional<Sidecar> sidecar = load_sidecar(beside, warnings);
    if (belongs_to(*sidecar, info)) return sidecar;
    warnings.push_back(fmt::format("'{}' seems to belong to another picture: its size or layout differs", beside));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    const std::string why = error.what();
    if (!known.layout && !known.projection) {
      throw Error(error.kind(), why + "; fix or remove it, or give the picture's layout and projection");
    }
    warnings.push_back(why + ": ignored");
  }
  return std::nullopt;
}

static bool is_taken_as_photo(const FileInfo& info, const std::string& path, const FormatHint& known) {
  return !info.is_float && !known.one_eye && !known.layout && !names_eye(path) && (info.is_pair || is_photo(path));
}

namespace {

// All that the sources of a format are asked for.
struct Evidence {
  const FileInfo& info;
  const std::string& path;
  const FormatHint& known;
  std::optional<Sidecar> sidecar;
  bool is_photo = false;
  NameWords words{};
  std::optional<StereoCamera> camera{};  // as specified by one of them
};

}  // namespace

// The first answer, in order of precedence.
template <typename Answer>
static auto first_answer(const Answer& answer) -> decltype(answer(FormatSource())) {
  for (const FormatSourceRow& row : kFormatSourceTable) {
    if (auto found = answer(row.member)) return found;
  }
  return {};
}

// From the descriptor of a JPS.
static std::optional<LayoutGuess> layout_in_descriptor(const FileInfo& info) {
  const auto said = info.text.find(kStereoLayout);
  if (said == info.text.end()) return std::nullopt;
  return LayoutGuess{layout_of(said->second), FormatSource::kOtherMetadata, "according to its JPS descriptor"};
}

static bool is_cross_eyed_by_custom(const std::string& path) {
  const std::string extension = small_letters(std::filesystem::path(path).extension().native());
  return extension == ".jps" || extension == ".pns";
}

// The file's size if its pixels were square.
static Extent shown_size(const FileInfo& info) {
  return {std::max(1, static_cast<int>(std::lround(info.width * pixel_aspect(info)))), info.height};
}

Extent shown_eye(const FileInfo& info, std::optional<Layout> layout) {
  const Layout how = layout.value_or(Layout::kSeparate);
  return whole_eye(how, without_middle(how, shown_size(info))).value_or(Extent{1, 1});
}

ProjectionSetting with_shape(ProjectionSetting setting, Extent shown) {
  if (setting.kind == kPerspective && setting.aspect == 1.0f)
    setting.aspect = static_cast<float>(shown.width) / static_cast<float>(shown.height);
  return setting;
}

static std::optional<LayoutGuess> layout_in(FormatSource source, const Evidence& of) {
  const Extent file = shown_size(of.info);
  const auto guess = [&](std::optional<Layout> layout, const std::string& reason) {
    return LayoutGuess{layout, source, reason};
  };
  switch (source) {
    case FormatSource::kOptions:
      if (names_eye(of.path)) return guess(Layout::kSeparate, "its name stands for two files");
      if (of.known.one_eye) return guess({}, "as asked");
      if (!of.known.seen_lenses.empty())
        return LayoutGuess{of.known.layout, FormatSource::kPixels, of.known.seen_lenses};
      return of.known.layout ? std::optional(guess(of.known.layout, "as asked")) : std::nullopt;
    case FormatSource::kOwnMetadata:
      if (of.is_photo && of.info.is_pair) return guess(Layout::kSeparate, "its stereo pair has both eyes");
      if (of.is_photo) return guess(Layout::kSeparate, "it is a VR photo with an embedded right eye");
      return declared_layout(of.info);
    case FormatSource::kSidecar:
      if (!of.sidecar) return std::nullopt;
      return guess(of.sidecar->eyes.size() == 1 ? std::nullopt : std::optional(of.sidecar->layout),
                   "according to its sidecar");
    case FormatSource::kOtherMetadata:
      if (has_view(of.info, "right") || has_view(of.info, "left")) return guess(Layout::kMultiview, "it has two views");
      return layout_in_descriptor(of.info);
    case FormatSource::kName:
      if (of.known.seen && of.known.seen->denies_name) return std::nullopt;
      if (of.words.layout_token.empty() && is_cross_eyed_by_custom(of.path))
        return guess(Layout::kCrossEyed, "a .jps or .pns is cross-eyed by custom");
      if (of.words.layout_token.empty()) return std::nullopt;
      return guess(of.words.layout, fmt::format("its name ends in {}", of.words.layout_token));
    case FormatSource::kPixels:
      return of.known.seen ? std::optional(guess(of.known.seen->layout, of.known.seen->reason)) : std::nullopt;
    case FormatSource::kShape:
      // GPano has no layout, but the part of the sphere that one eye covers.
      if (of.camera && has_shape(of.camera->projection, file))
        return LayoutGuess{{}, FormatSource::kOtherMetadata, "its metadata fits one eye"};
      if (of.known.projection) return layout_of_shape(file, of.known.projection);
      return layout_of_shape(file, of.words.projection ? std::optional(of.words.projection->setting) : std::nullopt);
    case FormatSource::kNothing:
      return guess({}, "nothing tells of two eyes");
  }
  return std::nullopt;
}

static int find_eye(const FileInfo& info, const std::optional<Sidecar>& sidecar) {
  if (sidecar && sidecar->eyes.size() == 1) return sidecar->eyes[0];
  for (const char* name : {"ods:layout", "view"}) {
    const auto said = info.text.find(name);
    if (said == info.text.end()) continue;
    for (int eye : {kLeft, kRight}) {
      if (said->second == eye_name(eye)) return eye;
    }
  }
  return kMono;
}

// From GPano, which has no eyes.
static std::optional<StereoCamera> camera_in_xmp(const std::string& path, std::vector<std::string>& warnings) {
  const std::string xmp = read_xmp(files_of(path).front());
  const std::optional<StereoCamera> camera = gpano_camera(xmp);
  if (camera && xmp_property(xmp, "GPano:ProjectionType").empty()) {
    warnings.push_back("its GPano gives a crop of the sphere but no projection, as VR180 cameras do: lat-long");
  }
  if (!camera && xmp.find("GPano:ProjectionType") != std::string::npos) {
    warnings.push_back(fmt::format("its GPano projection is {}; ods supports only lat-long, whole or a part",
                                   xmp_property(xmp, "GPano:ProjectionType")));
  }
  return camera;
}

// A square eye of a VR photo whose GPano has no crop is VR180, because no other camera writes such photos.
static std::optional<StereoCamera> camera_in_metadata(const Evidence& of, std::vector<std::string>& guesses) {
  if (of.info.is_float) {
    if (std::optional<StereoCamera> camera = placed_camera(of.info)) return camera;
    const auto envmap = of.info.text.find("textureformat");
    const bool is_lat_long = envmap != of.info.text.end() && envmap->second == "LatLong Environment";
    return is_lat_long ? std::optional(StereoCamera()) : std::nullopt;
  }
  if (std::optional<StereoCamera> camera = camera_in_xmp(of.path, guesses)) return camera;
  if (std::optional<StereoCamera> camera = placed_camera(of.info)) return camera;
  StereoCamera camera;
  if (of.info.is_pair && of.words.projection == nullptr) {
    const auto fov = of.info.numbers.find("heif:fov");
    const std::optional<float> said = fov != of.info.numbers.end() ? std::optional(fov->second[0]) : std::nullopt;
    camera.projection = phone_window(said, {of.info.width, of.info.height}, guesses);
    const auto baseline = of.info.numbers.find("heif:baseline");
    if (baseline != of.info.numbers.end()) camera.ipd = baseline->second[0];
    return camera;
  }
  if (!of.is_photo || of.info.width != of.info.height) return std::nullopt;
  camera.projection = find_projection("vr180")->setting;
  read_gpano_pose(read_xmp(of.path), camera);
  guesses.push_back("vr180: it is a VR photo with square eyes");
  return camera;
}

// Maps that the file mentions but does not contain come from the sidecar.
static std::optional<StereoCamera> camera_in(FormatSource source, const Evidence& of,
                                             std::vector<std::string>& guesses) {
  switch (source) {
    case FormatSource::kOptions:
      return of.known.camera;
    case FormatSource::kOwnMetadata:
      return camera_of(of.info, guesses, of.sidecar ? &of.sidecar->camera : nullptr);
    case FormatSource::kSidecar:
      return of.sidecar ? std::optional(of.sidecar->camera) : std::nullopt;
    case FormatSource::kOtherMetadata:
      return camera_in_metadata(of, guesses);
    default:
      return std::nullopt;
  }
}

static const NamedProjection* projection_of_shape(Extent eye) {
  for (const NamedProjection* shape : shapes()) {
    if (has_shape(shape->setting, eye)) return shape;
  }
  return nullptr;
}

namespace {

struct ProjectionGuess {
  ProjectionSetting setting;
  std::string reason;
};

}  // namespace

// Most pictures that are not about twice as wide as high are flat. A file with the shape of spheres may have a layout
// that its name or metadata does not tell rightly.
static ProjectionGuess guess_by_default(Extent eye, Extent file) {
  constexpr float kNarrow = 1.9f, kWide = 2.5f;  // wider than 16:9, which is flat
  const ProjectionSetting sphere = find_projection("lat-long")->setting;
  ProjectionSetting flat = find_projection("perspective")->setting;
  flat.aspect = static_cast<float>(eye.width) / static_cast<float>(eye.height);
  if (layout_of_shape(file, sphere)) return {sphere, "nothing tells what it shows, and the file has a sphere's shape"};
  if (flat.aspect > kNarrow && flat.aspect < kWide)
    return {sphere, "nothing tells what it shows, and its shape is nearly a sphere's"};
  return {flat, "nothing tells what it shows, and its shape is not a sphere's"};
}

// eye: its size before squeezing.
static std::optional<ProjectionGuess> projection_in(FormatSource source, const Evidence& of, Extent eye) {
  switch (source) {
    case FormatSource::kName:
      if (of.words.projection == nullptr) return std::nullopt;
      return ProjectionGuess{
          of.words.projection->setting,
          fmt::format("its name ends in {}",
                      of.words.projection_token.empty() ? of.words.layout_token : of.words.projection_token)};
    case FormatSource::kPixels:
      if (!of.known.seen) return std::nullopt;
      return ProjectionGuess{of.known.seen->projection, "its pixels look like it"};
    case FormatSource::kShape:
      if (const NamedProjection* shape = projection_of_shape(eye))
        return ProjectionGuess{shape->setting, "an eye has that shape"};
      return std::nullopt;
    case FormatSource::kNothing:
      return guess_by_default(eye, shown_size(of.info));
    default:
      return std::nullopt;
  }
}

// Sets the camera's projection if no camera is known.
static void guess_projection(const Evidence& of, StereoFormat& format) {
  const Extent eye = shown_eye(of.info, format.layout.layout);
  const ProjectionGuess guess = *first_answer([&](FormatSource source) { return projection_in(source, of, eye); });
  format.camera.projection = guess.setting;
  format.guesses.push_back(fmt::format("{}: {}", projection_name(guess.setting), guess.reason));
  format.is_open = of.words.projection == nullptr && !of.known.seen &&
                   (format.layout.source >= FormatSource::kShape || projection_of_shape(eye) == nullptr);
}

// Six faces have a projection and no layout.
static FormatHint known_of_faces(FormatHint known) {
  known.one_eye = true;
  if (!known.projection) known.projection = find_projection("cube-3x2")->setting;
  return known;
}

StereoFormat find_format(const FileInfo& info, const std::string& path, const FormatHint& given) {
  StereoFormat format;
  const FormatHint known = names_faces(path) ? known_of_faces(given) : given;
  Evidence of{info, path, known, find_sidecar(info, path, known, format.guesses)};
  of.is_photo = format.is_photo = is_taken_as_photo(info, path, known);
  of.words = read_name(path);
  of.camera = first_answer([&](FormatSource source) { return camera_in(source, of, format.guesses); });
  format.layout = *first_answer([&](FormatSource source) { return layout_in(source, of); });
  format.eye = find_eye(info, of.sidecar);
  format.front_and_back = known.front_and_back;
  const Layout layout = format.layout.layout.value_or(Layout::kSeparate);
  if (is_anaglyph(layout)) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': the eyes of an anaglyph cannot be separated", path));
  }
  if (info.text.contains("ods:layout") && !declared_layout(info)) {
    format.guesses.push_back("its ods:layout is invalid: ignored");
  }
  if (const auto fault = info.text.find(kStereoFault); fault != info.text.end()) {
    format.guesses.push_back(fault->second);
  }
  if (pixel_aspect(info) != 1.0) {
    format.guesses.push_back(
        fmt::format("its pixels are {:.4g} times as wide as high, by its metadata", pixel_aspect(info)));
  }
  if (const auto doubt = info.text.find(std::string(kPixelDoubt)); doubt != info.text.end()) {
    format.guesses.push_back(doubt->second);
  }
  if (is_guess(format.layout) && known.seen_lenses.empty()) {
    const std::string_view name = format.layout.layout ? layout_name(layout) : "one eye";
    format.guesses.push_back(fmt::format("{}: {}", name, format.layout.reason));
  }
  format.has_camera = of.camera.has_value();
  format.has_ipd = of.camera && (known.camera || of.sidecar || info.numbers.contains("ods:ipd") ||
                                 info.numbers.contains("heif:baseline"));
  if (of.camera) format.camera = *of.camera;
  if (known.projection) {
    format.camera.projection = *known.projection;
  } else if (!of.camera) {
    guess_projection(of, format);
  }
  return format;
}

// JSON starts with a brace, unlike every picture format.
static bool is_sidecar(const std::string& path) {
  if (path.ends_with(".json")) return true;
  const FileInput file(path);
  const std::string head = file.read(0, std::min<uint64_t>(file.size(), 64));
  const size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string::npos && head[first] == '{';
}

Sidecar open_camera(const std::string& path, std::vector<std::string>& warnings) {
  if (is_sidecar(path)) return load_sidecar(path, warnings);
  const FileInfo info = read_info(path);
  const StereoFormat format = find_format(info, path, {});
  if (!format.has_camera) {
    throw Error(ErrorKind::kInput,
                fmt::format("cannot use '{}': it has no camera metadata; give its .camera.json file instead", path));
  }
  warnings.insert(warnings.end(), format.guesses.begin(), format.guesses.end());
  Sidecar file;
  file.camera = format.camera;
  file.layout = format.layout.layout.value_or(default_layout(format.camera.projection));
  const bool has_both = format.layout.layout.has_value() || format.is_photo;
  file.eyes = has_both ? std::vector{kLeft, kRight} : std::vector{format.eye};
  const Layout packing = has_both ? file.layout : Layout::kSeparate;
  const Extent size{info.width, info.height};
  file.eye = whole_eye(packing, size).value_or(size);
  return file;
}

std::string name_fault(const std::string& path, std::optional<Layout> layout, const ProjectionSetting& projection) {
  const NameWords words = read_name(path);
  const bool packed = !layout || is_packing(*layout);
  if (!words.layout_token.empty() && packed && words.layout != layout) {
    const std::string_view is = layout ? layout_name(*layout) : "one eye";
    return fmt::format("its name ends in {}, but it is {}: other programs will rely on the name", words.layout_token,
                       is);
  }
  if (words.projection != nullptr && words.projection->setting.kind != projection.kind) {
    return fmt::format("its name ends in {}, but it is {}: other programs will rely on the name",
                       words.projection_token, projection_name(projection));
  }
  return {};
}

}  // namespace ods
