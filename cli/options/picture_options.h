// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a picture's form: how its eyes share a file, and its size by name.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "cli/options/layout_options.h"
#include "ods/camera/sizes.h"
#include "ods/files/frames.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/render/render_options.h"

// --size NAME sets width, height, layout and mono at once. Options take effect in the order in which they were added,
// so those added after it override it.
void add_size_option(Options& options, ods::RenderOptions& picture, ods::Layout& layout);

// Adds --size, --width, --height, --eyes, --layout, --sidecar. They change only the size and eyes of `picture`.
void add_picture_options(Options& options, ods::RenderOptions& picture, ods::SaveOptions& save);

// Sets what no option gave: a width of whole faces, and the layout that players expect for the projection.
void finish_picture_options(const Options& options, const ods::ProjectionSetting& projection,
                            ods::RenderOptions& picture, ods::SaveOptions& save);

// Whether a file of this name is scene-linear, so that neither exposure nor tone curve applies: exr and hdr.
bool keeps_light(const std::string& path);

// The names of a video's frames. Throws UsageError if the output has no place for their numbers.
ods::FrameNames video_names(const std::string& output);

// How to save a picture of this projection that is made from another picture, where no option decides: in the layout
// that the file's name says (x_360_TB.png), else in the other's (layout_of_converted()) if such a file can have it; a
// display-encoded picture keeps its values, a Cryptomatte its names.
void save_as_it_was(const ods::StoredPicture& picture, const ods::ProjectionSetting& projection,
                    const std::string& output, std::optional<ods::Layout> wished, bool has_tone,
                    ods::SaveOptions& save);

// Notes what was guessed about a picture.
void note_guesses(const std::string& path, const ods::StoredPicture& picture);

// Notes if readers of the file would trust a misleading name: y_LR.png for top-bottom.
void note_misleading_name(const std::string& output, const ods::SaveOptions& save, size_t eye_count,
                          const ods::ProjectionSetting& projection);

// Throws UsageError if `output` and `input` are the same file, under this name or another; %V stands for both eyes.
void refuse_overwriting(const std::string& output, const std::string& input);

// Throws UsageError with a suggestion if there is no such size.
const ods::NamedSize& size_by_name(const std::string& name);
