// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/stereo_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/camera/odd_halves.h"
#include "ods/files/file_input.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/phone_window.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/metadata/vr_photo.h"

namespace ods {

// --- the name --------------------------------------------------------------------------------------------------------

static bool is_packing(Layout layout) {
  const EyePacking how = arrangement_of(layout).how;
  return how != EyePacking::kMixed && how != EyePacking::kAlone;
}

// Parts after the format part of a name: frame numbers, fields of view.
static bool is_neutral_token(const std::string& word) {
  return word.find_first_not_of("0123456789xX") == std::string::npos;
}

static const NamedProjection* projection_token(const std::string& word) {
  if (word == "360" || word == "360x180") return find_projection("lat-long");
  if (word == "180" || word == "180x180") return find_projection("vr180");
  return find_projection(word);
}

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

NameWords read_name(const std::string& path) {
  NameWords words;
  std::string name = std::filesystem::path(path).stem().native();
  for (size_t at = name.find_last_of("_. "); at != std::string::npos; at = name.find_last_of("_. ")) {
    const std::string marked = name.substr(at);
    const std::string word = small_letters(marked.substr(1));
    const std::optional<Layout> layout = layout_of(word);
    // After a dot a number is a frame number, not an angle.
    const NamedProjection* projection = marked[0] == '.' && is_neutral_token(word) ? nullptr : projection_token(word);
    // A file named checkerboard usually shows a checkerboard pattern.
    const bool is_word = layout && is_packing(*layout) && arrangement_of(*layout).how != EyePacking::kCheckerboard;
    if (is_word || word == "mono") {
      words.layout = layout;
      words.is_mono = word == "mono";
      words.layout_token = marked;
    } else if (projection != nullptr) {
      words.projection = projection;
      words.projection_token = marked;
    } else if (!is_neutral_token(word)) {
      break;
    }
    if (!words.layout_token.empty() && words.projection != nullptr) break;
    name.resize(at);
  }
  return words;
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

// The projections that an aspect ratio alone identifies. 3:2 does not identify a cube, because most cameras' photos
// have it.
static std::vector<const NamedProjection*> shapes() {
  return {find_projection("lat-long"), find_projection("cube-6x1"), find_projection("cube-1x6")};
}

static LayoutGuess layout_of_shape(Extent file, const std::optional<ProjectionSetting>& known) {
  std::vector<ProjectionSetting> settings;
  if (known) settings.push_back(*known);
  for (const NamedProjection* shape : shapes()) {
    if (!known) settings.push_back(shape->setting);
  }
  for (const ProjectionSetting& setting : settings) {
    const std::string_view name = projection_name(setting);
    if (has_shape(setting, file)) {
      return {{}, LayoutSource::kShape, fmt::format("it has the shape of one eye, {}", name)};
    }
    for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
      const std::optional<Extent> eye = unpacked_size(layout, file);
      if (eye && has_shape(setting, *eye)) {
        return {layout, LayoutSource::kShape, fmt::format("it has the shape of two eyes, {}", name)};
      }
    }
  }
  return {{}, LayoutSource::kNothing, "nothing says otherwise"};
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
  LayoutGuess guess{layout_of(said->second), LayoutSource::kFile, "the file says so"};
  for (int eye : {kLeft, kRight, kMono}) {
    if (said->second == eye_name(eye)) return guess;
  }
  return guess.layout ? std::optional(guess) : std::nullopt;
}

bool is_guess(const LayoutGuess& guess) {
  return guess.source > LayoutSource::kFile;
}

LayoutGuess guess_layout(const FileInfo& info, const std::string& path,
                         const std::optional<ProjectionSetting>& projection) {
  if (const std::optional<LayoutGuess> said = declared_layout(info)) return *said;
  if (has_view(info, "right") || has_view(info, "left")) {
    return {Layout::kMultiview, LayoutSource::kFile, "it has two views"};
  }
  const NameWords words = read_name(path);
  if (!words.layout_token.empty()) {
    return {words.layout, LayoutSource::kName, fmt::format("its name ends in {}", words.layout_token)};
  }
  if (projection) return layout_of_shape({info.width, info.height}, projection);
  if (words.projection != nullptr) return layout_of_shape({info.width, info.height}, words.projection->setting);
  return layout_of_shape({info.width, info.height}, {});
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

static LayoutGuess find_layout(const FileInfo& info, const std::string& path, const FormatHint& known,
                               const std::optional<Sidecar>& sidecar, bool photo) {
  if (info.is_pair && photo) return {Layout::kSeparate, LayoutSource::kFile, "its stereo pair has both eyes"};
  if (photo) return {Layout::kSeparate, LayoutSource::kFile, "it is a VR photo with an embedded right eye"};
  if (names_eye(path)) return {Layout::kSeparate, LayoutSource::kPair, "its name stands for two files"};
  if (known.one_eye) return {std::nullopt, LayoutSource::kCaller, "as asked"};
  if (known.layout) return {known.layout, LayoutSource::kCaller, "as asked"};
  if (sidecar && !declared_layout(info)) {
    const bool is_one = sidecar->eyes.size() == 1;
    return {is_one ? std::nullopt : std::optional(sidecar->layout), LayoutSource::kSidecar, "its sidecar says so"};
  }
  const LayoutGuess guess = guess_layout(info, path, known.projection);
  if (known.seen && guess.source > LayoutSource::kPixels) {
    return {known.seen->layout, LayoutSource::kPixels, known.seen->reason};
  }
  return guess;
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

static std::optional<StereoCamera> camera_in_file(const FileInfo& info, const std::string& path,
                                                  const StereoCamera* maps, std::vector<std::string>& warnings) {
  if (std::optional<StereoCamera> camera = camera_of(info, warnings, maps)) return camera;
  if (!info.is_float) {
    const std::string xmp = read_xmp(names_eye(path) ? path_for_eye(path, kLeft) : path);
    const std::optional<StereoCamera> camera = gpano_camera(xmp);
    if (camera && xmp_property(xmp, "GPano:ProjectionType").empty()) {
      warnings.push_back("its GPano gives a crop of the sphere but no projection, as VR180 cameras do: lat-long");
    }
    if (!camera && xmp.find("GPano:ProjectionType") != std::string::npos) {
      warnings.push_back(fmt::format("its GPano says {}; ods supports only lat-long, whole or a part",
                                     xmp_property(xmp, "GPano:ProjectionType")));
    }
    return camera;
  }
  const auto envmap = info.text.find("textureformat");
  if (envmap != info.text.end() && envmap->second == "LatLong Environment") return StereoCamera();
  return std::nullopt;
}

static const NamedProjection* projection_of_shape(Extent eye) {
  for (const NamedProjection* shape : shapes()) {
    if (has_shape(shape->setting, eye)) return shape;
  }
  return nullptr;
}

// From the name, else from the pixels, else from the aspect ratio of an eye before squeezing.
static ProjectionSetting guess_projection(Extent eye, const std::string& path, const FormatHint& known,
                                          std::vector<std::string>& guesses) {
  const NameWords words = read_name(path);
  const auto guess = [&](const NamedProjection& named, const std::string& reason) {
    guesses.push_back(fmt::format("{}: {}", named.name, reason));
    return named.setting;
  };
  if (words.projection) return guess(*words.projection, fmt::format("its name ends in {}", words.projection_token));
  if (known.seen) {
    guesses.push_back(fmt::format("{}: its pixels look like it", projection_name(known.seen->projection)));
    return known.seen->projection;
  }
  if (const NamedProjection* shape = projection_of_shape(eye)) return guess(*shape, "an eye has that shape");
  return guess(*find_projection("lat-long"), "nothing says otherwise");
}

// The file's own metadata takes precedence over its sidecar, which may be older. Maps that the file mentions but does
// not contain come from the sidecar.
static std::optional<StereoCamera> find_stated_camera(const FileInfo& info, const std::string& path,
                                                      const FormatHint& known, const std::optional<Sidecar>& sidecar,
                                                      std::vector<std::string>& guesses) {
  if (known.camera) return known.camera;
  if (sidecar && !info.text.contains("ods:projection")) return sidecar->camera;
  const StereoCamera* maps = sidecar ? &sidecar->camera : nullptr;
  if (std::optional<StereoCamera> own = camera_in_file(info, path, maps, guesses)) return own;
  return sidecar ? std::optional(sidecar->camera) : std::nullopt;
}

static StereoCamera camera_of_pair(const FileInfo& info, std::vector<std::string>& guesses) {
  const auto said = info.numbers.find("heif:fov");
  std::optional<float> fov;
  if (said != info.numbers.end()) fov = said->second[0];
  StereoCamera camera;
  camera.projection = phone_window(fov, {info.width, info.height}, guesses);
  return camera;
}

// A square eye of a VR photo whose GPano has no crop is VR180, because no other camera writes such photos.
static std::optional<StereoCamera> find_camera(const FileInfo& info, const std::string& path, const FormatHint& known,
                                               const std::optional<Sidecar>& sidecar, StereoFormat& format) {
  std::optional<StereoCamera> camera = find_stated_camera(info, path, known, sidecar, format.guesses);
  if (!camera && info.is_pair) return camera_of_pair(info, format.guesses);
  if (camera || !format.is_photo || info.width != info.height) return camera;
  camera.emplace().projection = find_projection("vr180")->setting;
  read_gpano_pose(read_xmp(path), *camera);
  format.guesses.push_back("vr180: it is a VR photo with square eyes");
  return camera;
}

StereoFormat find_format(const FileInfo& info, const std::string& path, const FormatHint& known) {
  StereoFormat format;
  const std::optional<Sidecar> sidecar = find_sidecar(info, path, known, format.guesses);
  format.is_photo = is_taken_as_photo(info, path, known);
  format.layout = find_layout(info, path, known, sidecar, format.is_photo);
  const std::optional<StereoCamera> camera = find_camera(info, path, known, sidecar, format);
  format.has_camera = camera.has_value();
  // GPano has no layout, but the part of the sphere that one eye covers: if the file has its aspect ratio, there is
  // only one eye.
  if (camera && format.layout.source >= LayoutSource::kShape &&
      has_shape(camera->projection, {info.width, info.height}))
    format.layout = {{}, LayoutSource::kFile, "its metadata fits one eye"};
  format.eye = find_eye(info, sidecar);
  const Layout layout = format.layout.layout.value_or(Layout::kSeparate);
  if (is_anaglyph(layout)) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': the eyes of an anaglyph cannot be separated", path));
  }
  if (info.text.contains("ods:layout") && !declared_layout(info)) {
    format.guesses.push_back("its ods:layout is invalid: ignored");
  }
  if (is_guess(format.layout)) {
    const std::string_view name = format.layout.layout ? layout_name(layout) : "one eye";
    format.guesses.push_back(fmt::format("{}: {}", name, format.layout.reason));
  }
  format.has_ipd = camera && (known.camera || sidecar || info.numbers.contains("ods:ipd"));
  if (camera) format.camera = *camera;
  if (known.projection) {
    format.camera.projection = *known.projection;
  } else if (!camera) {
    const Extent eye =
        whole_eye(layout, without_middle(layout, Extent{info.width, info.height})).value_or(Extent{1, 1});
    format.camera.projection = guess_projection(eye, path, known, format.guesses);
    format.is_open = read_name(path).projection == nullptr && !known.seen &&
                     (format.layout.source >= LayoutSource::kShape || projection_of_shape(eye) == nullptr);
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
    return fmt::format("its name ends in {}, but it is {}: programs will believe the name", words.layout_token, is);
  }
  if (words.projection != nullptr && words.projection->setting.kind != projection.kind) {
    return fmt::format("its name ends in {}, but it is {}: programs will believe the name", words.projection_token,
                       projection_name(projection));
  }
  return {};
}

}  // namespace ods
