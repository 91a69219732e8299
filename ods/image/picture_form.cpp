// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/picture_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/image/camera_file.h"
#include "ods/image/metadata.h"

namespace ods {

// --- the name --------------------------------------------------------------------------------------------------------

static bool is_packing(Layout layout) {
  return !is_anaglyph(layout) && layout != Layout::kSeparate && layout != Layout::kMultiview;
}

// Words that stand behind the others: frame numbers, fields of view.
static bool says_nothing(const std::string& word) {
  return word.find_first_not_of("0123456789xX") == std::string::npos;
}

static const NamedProjection* projection_word(const std::string& word) {
  if (word == "360" || word == "360x180") return find_projection("lat-long");
  if (word == "180" || word == "180x180") return find_projection("vr180");
  return find_projection(word);
}

NameWords read_name(const std::string& path) {
  NameWords words;
  std::string name = std::filesystem::path(path).stem().native();
  for (size_t at = name.find_last_of("_. "); at != std::string::npos; at = name.find_last_of("_. ")) {
    const std::string marked = name.substr(at);
    std::string word = marked.substr(1);
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::optional<Layout> layout = layout_of(word);
    // Behind a point stands the number of a frame, not an angle.
    const NamedProjection* projection = marked[0] == '.' && says_nothing(word) ? nullptr : projection_word(word);
    if ((layout && is_packing(*layout)) || word == "mono") {
      words.layout = layout;
      words.is_mono = word == "mono";
      words.layout_word = marked;
    } else if (projection != nullptr) {
      words.projection = projection;
      words.projection_word = marked;
    } else if (!says_nothing(word)) {
      break;
    }
    if (!words.layout_word.empty() && words.projection != nullptr) break;
    name.resize(at);
  }
  return words;
}

// --- the shape -------------------------------------------------------------------------------------------------------

static bool has_shape(const ProjectionSetting& setting, Extent eye) {
  return eye.width % width_step(setting) == 0 && natural_height(setting, eye.width) == eye.height;
}

// Those that a shape alone tells apart.
static std::vector<const NamedProjection*> shapes() {
  return {find_projection("lat-long"), find_projection("cube-3x2"), find_projection("cube-6x1"),
          find_projection("cube-1x6")};
}

static LayoutGuess layout_of_shape(Extent file, const std::optional<ProjectionSetting>& known) {
  std::vector<ProjectionSetting> settings;
  if (known) settings.push_back(*known);
  for (const NamedProjection* shape : shapes()) {
    if (!known) settings.push_back(shape->setting);
  }
  for (const ProjectionSetting& setting : settings) {
    const std::string_view name = projection_name(setting);
    if (has_shape(setting, file)) return {{}, fmt::format("it has the shape of one eye, {}", name)};
    for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
      const std::optional<Extent> eye = unpacked_size(layout, file);
      if (eye && has_shape(setting, *eye)) return {layout, fmt::format("it has the shape of two eyes, {}", name)};
    }
  }
  return {{}, "nothing says otherwise"};
}

static bool has_channel(const FileInfo& info, const std::string& name) {
  return std::find(info.channels.begin(), info.channels.end(), name) != info.channels.end();
}

LayoutGuess guess_layout(const FileInfo& info, const std::string& path,
                         const std::optional<ProjectionSetting>& projection) {
  const auto said = info.text.find("ods:layout");
  if (said != info.text.end()) return {layout_of(said->second), "the file says so", true};
  if (has_channel(info, "right.R") || has_channel(info, "left.R"))
    return {Layout::kMultiview, "it has two views", true};
  const NameWords words = read_name(path);
  if (!words.layout_word.empty()) return {words.layout, fmt::format("its name ends in {}", words.layout_word)};
  if (projection) return layout_of_shape({info.width, info.height}, projection);
  if (words.projection != nullptr) return layout_of_shape({info.width, info.height}, words.projection->setting);
  return layout_of_shape({info.width, info.height}, {});
}

// --- the whole -------------------------------------------------------------------------------------------------------

// A sidecar may be that of another picture of this name: picture.exr and picture.png share one.
static bool belongs_to(const CameraFile& sidecar, const FileInfo& info) {
  const int count = static_cast<int>(sidecar.eyes.size());
  if (count == 2 && sidecar.layout == Layout::kMultiview && !has_channel(info, "right.R")) return false;
  if (sidecar.eye.width == 0) return true;
  const Extent size = packed_size(sidecar.layout, squeezed_eye(sidecar.layout, sidecar.eye, count), count);
  return size.width == info.width && size.height == info.height;
}

static std::optional<CameraFile> find_sidecar(const FileInfo& info, const std::string& path, const KnownForm& known,
                                              std::vector<std::string>& warnings) {
  const std::string beside = sidecar_path(path);
  std::error_code ignored;
  if (known.camera || !std::filesystem::exists(beside, ignored)) return std::nullopt;
  std::optional<CameraFile> sidecar = load_camera(beside, warnings);
  if (belongs_to(*sidecar, info)) return sidecar;
  warnings.push_back(fmt::format("'{}' is of another picture, going by its size and layout", beside));
  return std::nullopt;
}

static LayoutGuess find_layout(const FileInfo& info, const std::string& path, const KnownForm& known,
                               const std::optional<CameraFile>& sidecar) {
  if (names_eye(path)) return {Layout::kSeparate, "its name stands for two files", true};
  if (known.layout) return {known.layout, "as asked", true};
  if (sidecar && !info.text.contains("ods:layout")) {
    if (sidecar->eyes.size() == 1) return {{}, "its sidecar says so", true};
    return {sidecar->layout, "its sidecar says so", true};
  }
  return guess_layout(info, path, known.projection);
}

static int find_eye(const FileInfo& info, const std::optional<CameraFile>& sidecar) {
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

static std::optional<CameraRig> camera_in_file(const FileInfo& info, const std::string& path,
                                               std::vector<std::string>& warnings) {
  if (std::optional<CameraRig> camera = camera_of(info, warnings)) return camera;
  if (!info.is_float) return gpano_camera(read_xmp(names_eye(path) ? path_for_eye(path, kLeft) : path));
  const auto envmap = info.text.find("textureformat");
  if (envmap != info.text.end() && envmap->second == "LatLong Environment") return CameraRig();
  return std::nullopt;
}

// By the name, else the shape of an eye as it was before it was squeezed.
static ProjectionSetting guess_projection(Extent eye, const std::string& path, std::vector<std::string>& guesses) {
  const NameWords words = read_name(path);
  const auto guess = [&](const NamedProjection& named, const std::string& because) {
    guesses.push_back(fmt::format("{}: {}", named.name, because));
    return named.setting;
  };
  if (words.projection) return guess(*words.projection, fmt::format("its name ends in {}", words.projection_word));
  for (const NamedProjection* shape : shapes()) {
    if (has_shape(shape->setting, eye)) return guess(*shape, "an eye has that shape");
  }
  return guess(*find_projection("lat-long"), "nothing says otherwise");
}

PictureForm find_form(const FileInfo& info, const std::string& path, const KnownForm& known) {
  PictureForm form;
  const std::optional<CameraFile> sidecar = find_sidecar(info, path, known, form.guesses);
  form.layout = find_layout(info, path, known, sidecar);
  form.eye = find_eye(info, sidecar);
  const Layout layout = form.layout.layout.value_or(Layout::kSeparate);
  if (is_anaglyph(layout)) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': nobody can take an anaglyph apart again", path));
  }
  if (!form.layout.is_certain) {
    const std::string_view name = form.layout.layout ? layout_name(layout) : "one eye";
    form.guesses.push_back(fmt::format("{}: {}", name, form.layout.because));
  }
  std::optional<CameraRig> camera = known.camera;
  if (!camera && sidecar) camera = sidecar->rig;
  if (!camera) camera = camera_in_file(info, path, form.guesses);
  form.camera_is_said = camera.has_value();
  if (camera) form.camera = *camera;
  if (known.projection) {
    form.camera.projection = *known.projection;
  } else if (!camera) {
    const Extent eye = unpacked_size(layout, {info.width, info.height}).value_or(Extent{1, 1});
    const Extent squeeze = squeeze_of(layout, 2);
    form.camera.projection =
        guess_projection({eye.width * squeeze.width, eye.height * squeeze.height}, path, form.guesses);
  }
  return form;
}

}  // namespace ods
