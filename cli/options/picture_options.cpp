// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/picture_options.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/camera/file_names.h"
#include "ods/camera/sizes.h"
#include "ods/image/format/file_format.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/picture/stereo_file.h"
#include "ods/stage/exposure.h"

using ods::Layout;

const ods::NamedSize& size_by_name(const std::string& name) {
  for (const ods::NamedSize& size : ods::named_sizes()) {
    if (size.name == name) return size;
  }
  throw UsageError(fmt::format("there is no size '{}'{} (ods sizes lists them)", name,
                               ods::did_you_mean(name, ods::names_of(ods::named_sizes()))));
}

std::optional<int> PictureForm::given_width() const {
  return width || !size ? width : size->eye.width;
}

std::optional<int> PictureForm::given_height() const {
  if (height) return height;
  if (width) return 0;  // not the height of another width
  return size ? std::optional(size->eye.height) : std::nullopt;
}

std::optional<ods::Eyes> PictureForm::given_eyes() const {
  if (eyes || !size) return eyes;
  return size->layout ? ods::Eyes::kBothEyes : ods::Eyes::kMonoEye;
}

std::optional<Layout> PictureForm::given_layout() const {
  if (layout || !size) return layout;
  return size->layout.value_or(Layout::kTopBottom);
}

void add_size_option(Options& options, PictureForm& form) {
  options.custom(
      "--size", "NAME", "", [&form](const std::string& name) { form.size = &size_by_name(name); },
      "set width, height, layout and eyes to a named size (ods sizes lists them)");
  options.offer("--size", ods::names_of(ods::named_sizes()));
}

void add_picture_options(Options& options, PictureForm& form, bool& sidecar) {
  add_size_option(options, form);
  options.number("--width", form.width, 1, 32768, "width of one eye in pixels", fmt::format("{}", form.usual_width));
  options.number("--height", form.height, 0, 32768,
                 "height of one eye in pixels; 0: follows from the width and projection (lat-long: half the width)",
                 "0");
  options.choice("--eyes", form.eyes, ods::kEyesTable, "which eyes to make", "both");
  add_layout_option(options, form.layout, "how both eyes share the file (default for vr180: side-by-side)", "--layout",
                    "top-bottom");
  options.flag("--sidecar", sidecar,
               "also write the camera to picture.camera.json, which --camera-file of other commands reads");
}

void use_form(const PictureForm& form, CameraOptions& camera, ods::RenderOptions& picture, ods::SaveOptions& save) {
  const ods::ProjectionSetting projection = changed(camera.stereo.projection, camera.changes.projection);
  picture.width = form.given_width().value_or(form.usual_width - form.usual_width % ods::width_step(projection));
  picture.height = form.given_height().value_or(0);
  picture.eyes = form.given_eyes().value_or(ods::Eyes::kBothEyes);
  save.layout = form.given_layout().value_or(ods::default_layout(projection));
  finish_camera_options(camera, picture.width, picture.height);
}

void add_display_options(Options& options, DisplayOptions& display) {
  options.number("--exposure", display.exposure, -ods::kMaxStops, ods::kMaxStops,
                 "exposure in stops; .hdr and .exr stay scene-linear and ignore it", "0");
  options.choice("--tone", display.tone, ods::kToneCurveTable,
                 "tone curve for scene-linear light; .hdr and .exr ignore it",
                 std::string(ods::tone_curve_name(ods::SaveOptions().tone)));
}

ods::FrameNames video_names(const std::string& output) {
  if (const auto names = ods::frame_names(output)) return *names;
  throw UsageError("frames need a place for their number in the file name: -o shot.####.png");
}

void save_as_it_was(const ods::StoredPicture& picture, const ods::ProjectionSetting& projection,
                    const std::string& output, std::optional<Layout> requested, const DisplayOptions& display,
                    ods::SaveOptions& save) {
  const Layout own = picture.layout;
  const bool unfit = own == Layout::kSeparate || (own == Layout::kMultiview && !ods::keeps_layers(output));
  const std::optional<Layout> named = ods::read_name(output).layout;
  const bool is_named = named && ods::arrangement_of(*named).is_halves();
  const bool is_jps = ods::stereo_file(output) == ods::StereoFile::kJps;  // cross-eyed, by custom
  save.layout = requested.value_or(is_named ? *named
                                   : is_jps ? Layout::kCrossEyed
                                   : unfit  ? ods::default_layout(projection)
                                            : ods::layout_of_converted(own, picture.camera.projection, projection));
  save.exposure = display.exposure.value_or(save.exposure);
  save.tone = display.tone.value_or(picture.is_float ? save.tone : ods::ToneCurve::kLinear);
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
  for (const std::string& out : ods::files_of(output)) {
    for (const std::string& in : ods::files_of(input)) {
      if (!std::filesystem::equivalent(out, in, none)) continue;
      throw UsageError(fmt::format("'{}' would be overwritten by its own output: choose another name", in));
    }
  }
}

bool keeps_light(const std::string& path) {
  const auto format = ods::format_of_path(path);
  return format && ods::is_scene_referred(*format);
}
