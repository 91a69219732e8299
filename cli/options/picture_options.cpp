// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/picture_options.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/camera/sizes.h"
#include "ods/image/format/file_format.h"
#include "ods/picture/metadata/stereo_format.h"

using ods::Layout;

const ods::NamedSize& size_by_name(const std::string& name) {
  for (const ods::NamedSize& size : ods::named_sizes()) {
    if (size.name == name) return size;
  }
  throw UsageError(fmt::format("there is no size '{}'{} (ods sizes lists them)", name,
                               ods::did_you_mean(name, ods::names_of(ods::named_sizes()))));
}

void add_size_option(Options& options, ods::RenderOptions& picture, Layout& layout) {
  auto set = [&](const std::string& name) {
    const ods::NamedSize& size = size_by_name(name);
    picture.width = size.eye.width;
    picture.height = size.eye.height;
    layout = size.layout.value_or(layout);
    if (!size.layout) picture.eyes = ods::Eyes::kMonoEye;
  };
  options.custom("--size", "NAME", "", set,
                 "set width, height, layout and eyes to a named size (ods sizes lists them)");
  options.offer("--size", ods::names_of(ods::named_sizes()));
}

void add_picture_options(Options& options, ods::RenderOptions& picture, ods::SaveOptions& save) {
  add_size_option(options, picture, save.layout);
  options.number("--width", picture.width, 1, 32768, "width of one eye in pixels");
  options.number("--height", picture.height, 0, 32768,
                 "height of one eye in pixels; 0: follows from the width and projection (lat-long: half the width)");
  options.choice("--eyes", picture.eyes, ods::kEyesTable, "which eyes to make");
  add_layout_option(options, save.layout, "how both eyes share the file (default for vr180: side-by-side)");
  options.flag("--sidecar", save.sidecar,
               "also write the camera to picture.camera.json, which --from of other commands reads");
}

void finish_picture_options(const Options& options, const ods::ProjectionSetting& projection,
                            ods::RenderOptions& picture, ods::SaveOptions& save) {
  const bool sized = options.given("--size");
  if (options.given("--width") && !options.given("--height")) picture.height = 0;
  if (!options.given("--width") && !sized) picture.width -= picture.width % ods::width_step(projection);
  if (!options.given("--layout") && !sized) save.layout = ods::default_layout(projection);
}

ods::FrameNames video_names(const std::string& output) {
  if (const auto names = ods::frame_names(output)) return *names;
  throw UsageError("frames need a place for their number in the file name: -o shot.####.png");
}

void save_as_it_was(const ods::StoredPicture& picture, const ods::ProjectionSetting& projection,
                    const std::string& output, std::optional<Layout> wished, bool has_tone, ods::SaveOptions& save) {
  const Layout own = picture.layout;
  const bool unfit = own == Layout::kSeparate || (own == Layout::kMultiview && !ods::keeps_layers(output));
  const std::optional<Layout> named = ods::read_name(output).layout;
  const bool is_named = named && ods::arrangement_of(*named).is_halves();
  save.layout = wished.value_or(is_named ? *named
                                : unfit  ? ods::default_layout(projection)
                                         : ods::layout_of_converted(own, picture.camera.projection, projection));
  if (!has_tone && !picture.is_float) save.tone = ods::ToneCurve::kLinear;
  if (ods::keeps_layers(output)) {
    save.attributes.insert(save.attributes.end(), picture.mattes.begin(), picture.mattes.end());
  }
}

void note_guesses(const std::string& path, const ods::StoredPicture& picture) {
  for (const std::string& guess : picture.guesses) note(fmt::format("{}: {}", path, guess));
}

void note_misleading_name(const std::string& output, const ods::SaveOptions& save, size_t eye_count,
                          const ods::ProjectionSetting& projection) {
  const auto layout = eye_count == 2 ? std::optional(save.layout) : std::nullopt;
  const std::string fault = ods::name_fault(output, layout, projection);
  if (!fault.empty()) warn(fmt::format("'{}': {}", output, fault));
}

void refuse_overwriting(const std::string& output, const std::string& input) {
  std::error_code none;  // a file that does not exist is not the other file
  for (const int eye : {ods::kLeft, ods::kRight}) {
    for (const int other : {ods::kLeft, ods::kRight}) {
      const std::string out = ods::names_eye(output) ? ods::path_for_eye(output, eye) : output;
      const std::string in = ods::names_eye(input) ? ods::path_for_eye(input, other) : input;
      if (!std::filesystem::equivalent(out, in, none)) continue;
      throw UsageError(fmt::format("'{}' would be overwritten by its own output: choose another name", in));
    }
  }
}

bool keeps_light(const std::string& path) {
  const auto format = ods::format_of_path(path);
  return format && ods::is_scene_referred(*format);
}
