// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a picture's form: how its eyes share a file, and its size by name.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "cli/options/camera_options.h"
#include "cli/options/layout_options.h"
#include "ods/camera/sizes.h"
#include "ods/files/frames.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/render/render_options.h"

// A picture's form as the options specify it; fields that are absent follow from the projection and the command's
// default.
struct PictureForm {
  const ods::NamedSize* size = nullptr;  // --size: width, height, layout and eyes at once; the others override it
  std::optional<int> width, height;      // of one eye; height 0: follows from the width and the projection
  std::optional<ods::Eyes> eyes;
  std::optional<ods::Layout> layout;
  int usual_width = 2048;  // without --width and --size

  std::optional<int> given_width() const;
  std::optional<int> given_height() const;
  std::optional<ods::Eyes> given_eyes() const;
  std::optional<ods::Layout> given_layout() const;
};

void add_size_option(Options& options, PictureForm& form);

// Adds --size, --width, --height, --eyes, --layout, --sidecar.
void add_picture_options(Options& options, PictureForm& form, bool& sidecar);

// Applies the camera's changes, and sets the size and the eyes of `picture` and the layout of `save`. The usual width
// becomes one of whole faces; the usual layout is the one that players expect for the projection. Throws as
// finish_camera_options() does.
void use_form(const PictureForm& form, CameraOptions& camera, ods::RenderOptions& picture, ods::SaveOptions& save);

// The conversion of scene-linear light for a display; fields that are absent have the command's default.
struct DisplayOptions {
  std::optional<float> exposure;  // stops
  std::optional<ods::ToneCurve> tone;
};

// Adds --exposure and --tone.
void add_display_options(Options& options, DisplayOptions& display);

// Returns whether a file of this name is scene-linear, so that neither exposure nor tone curve applies: exr and hdr.
bool keeps_light(const std::string& path);

// The names of a video's frames. Throws UsageError if the output has no place for their numbers.
ods::FrameNames video_names(const std::string& output);

// Sets how to save a picture of this projection that is made from another picture, unless options do: in the layout by
// the file's name (x_360_TB.png), else in the other picture's (layout_of_converted()) if such a file can have it; a
// display-encoded picture keeps its values, a Cryptomatte its names.
void save_as_it_was(const ods::StoredPicture& picture, const ods::ProjectionSetting& projection,
                    const std::string& output, std::optional<ods::Layout> requested, const DisplayOptions& display,
                    ods::SaveOptions& save);

// Notes the guesses about a picture.
void note_guesses(const std::string& path, const ods::StoredPicture& picture);

// Notes if readers of the file would trust a misleading name: y_LR.png for top-bottom.
void note_misleading_name(const std::string& output, const ods::SaveOptions& save, size_t eye_count,
                          const ods::ProjectionSetting& projection);

// Throws UsageError if `output` and `input` are the same file, under this name or another; %V stands for both eyes.
void refuse_overwriting(const std::string& output, const std::string& input);

// Throws UsageError with a suggestion if there is no such size.
const ods::NamedSize& size_by_name(const std::string& name);
