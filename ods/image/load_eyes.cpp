// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/load_eyes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

static Error unreadable(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}", path, why));
}

static bool has_channel(const FileInfo& info, const std::string& name) {
  return std::find(info.channels.begin(), info.channels.end(), name) != info.channels.end();
}

// --- the guess -----------------------------------------------------------------------------------------------------

static bool is_packing(Layout layout) {
  return !is_anaglyph(layout) && layout != Layout::kSeparate && layout != Layout::kMultiview;
}

// Words that stand behind a layout's: frame numbers, fields of view.
static bool says_no_layout(const std::string& word) {
  return word.find_first_not_of("0123456789xX") == std::string::npos;
}

static LayoutGuess guess_from_name(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().native();
  for (size_t at = name.find_last_of("_. "); at != std::string::npos; at = name.find_last_of("_. ")) {
    const std::string word = name.substr(at + 1);
    const std::optional<Layout> layout = layout_of(word);
    if (layout && is_packing(*layout)) return {layout, fmt::format("its name ends in {}{}", name[at], word)};
    if (!says_no_layout(word)) break;
    name.resize(at);
  }
  return {};
}

LayoutGuess guess_layout(const FileInfo& info, const std::string& path) {
  const auto said = info.text.find("ods:layout");
  if (said != info.text.end()) return {layout_of(said->second), "the file says so"};
  if (has_channel(info, "right.R") || has_channel(info, "left.R")) return {Layout::kMultiview, "it has two views"};
  const LayoutGuess named = guess_from_name(path);
  if (named.layout) return named;
  if (info.width == info.height) return {Layout::kTopBottom, "it is as wide as high"};
  if (info.width == 4 * info.height) return {Layout::kSideBySide, "it is four times as wide as high"};
  if (info.width == 2 * info.height) return {std::nullopt, "it is twice as wide as high"};
  return {std::nullopt, "nothing says otherwise"};
}

// --- the eyes ------------------------------------------------------------------------------------------------------

static std::vector<std::string> rgb(const std::string& prefix) {
  return {prefix + "R", prefix + "G", prefix + "B"};
}

// The default view of a file has bare names, whichever it is.
static std::string light_prefix(const FileInfo& info, int eye) {
  const std::string named = fmt::format("{}.", eye_name(eye));
  return has_channel(info, named + "R") ? named : "";
}

static void load_views(LoadedEyes& loaded, const FileInfo& info, const std::string& path) {
  if (light_prefix(info, kLeft) == light_prefix(info, kRight)) throw unreadable(path, "it does not hold two views");
  for (int eye : {kLeft, kRight}) {
    loaded.eyes.push_back(read_channels(path, rgb(light_prefix(info, eye))));
    const std::string variance = fmt::format("variance.{}.", eye_name(eye));
    if (has_channel(info, variance + "R")) loaded.variance.push_back(read_channels(path, rgb(variance)));
  }
  if (loaded.variance.size() == 1) loaded.variance.clear();
}

static void load_packed(LoadedEyes& loaded, const FileInfo& info, const std::string& path) {
  const Layout layout = loaded.guess.layout.value_or(Layout::kSeparate);
  if (!unpacked_size(layout, {info.width, info.height})) {
    throw unreadable(path,
                     fmt::format("{}x{} pixels are not two eyes, {}", info.width, info.height, layout_name(layout)));
  }
  loaded.eyes = unpack(layout, read_image(path));
  if (has_channel(info, "variance.R")) loaded.variance = unpack(layout, read_channels(path, rgb("variance.")));
}

static LoadedEyes load_file(const std::string& path, std::optional<Layout> layout) {
  const FileInfo info = read_info(path);
  LoadedEyes loaded;
  loaded.guess = layout ? LayoutGuess{layout, "as asked"} : guess_layout(info, path);
  loaded.is_float = info.is_float;
  if (const auto said = info.text.find("ods:projection"); said != info.text.end()) loaded.projection = said->second;
  if (loaded.guess.layout && is_anaglyph(*loaded.guess.layout)) {
    throw unreadable(path, "nobody can take an anaglyph apart again");
  }
  if (loaded.guess.layout == Layout::kMultiview) {
    load_views(loaded, info, path);
  } else {
    load_packed(loaded, info, path);
  }
  if (loaded.guess.layout == Layout::kSeparate) loaded.guess.layout.reset();
  return loaded;
}

static LoadedEyes load_pair(const std::string& path) {
  LoadedEyes pair = load_file(path_for_eye(path, kLeft), Layout::kSeparate);
  LoadedEyes right = load_file(path_for_eye(path, kRight), Layout::kSeparate);
  const Image &one = pair.eyes[0], &other = right.eyes[0];
  if (one.width != other.width || one.height != other.height) {
    throw unreadable(
        path, fmt::format("its eyes have {}x{} and {}x{} pixels", one.width, one.height, other.width, other.height));
  }
  pair.eyes.push_back(std::move(right.eyes[0]));
  if (right.variance.empty()) pair.variance.clear();
  if (!pair.variance.empty()) pair.variance.push_back(std::move(right.variance[0]));
  pair.guess = {Layout::kSeparate, "its name stands for two files"};
  return pair;
}

LoadedEyes load_eyes(const std::string& path, std::optional<Layout> layout) {
  return names_eye(path) ? load_pair(path) : load_file(path, layout);
}

}  // namespace ods
