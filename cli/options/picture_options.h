// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a picture's form: how its eyes share a file, its size by name.
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

// --size NAME: width, height, layout and mono at once. Options take effect in the order in which they were added, so
// that those added after it go before it.
void add_size_option(Options& options, ods::RenderOptions& picture, ods::Layout& layout);

// It, --width, --height, --eyes, --layout, --sidecar. Of the picture only its size and eyes are touched.
void add_picture_options(Options& options, ods::RenderOptions& picture, ods::SaveOptions& save);

// What nobody gave: a width of whole faces, the layout that players expect of the projection.
void finish_picture_options(const Options& options, const ods::ProjectionSetting& projection,
                            ods::RenderOptions& picture, ods::SaveOptions& save);

// Whether a file of this name holds the scene's light, which is neither exposed nor toned: exr and hdr.
bool keeps_light(const std::string& path);

// The names of a video's frames. Throws UsageError: the output has no place for their numbers.
ods::FrameNames video_names(const std::string& output);

// How to save a picture of this projection that is made of another picture, as far as no option says it: in the other's
// layout (layout_of_converted()) where a file of that name can have it, and what a display shows as it is.
void save_as_it_was(const ods::StoredPicture& picture, const ods::ProjectionSetting& projection,
                    const std::string& output, std::optional<ods::Layout> wished, bool has_tone,
                    ods::SaveOptions& save);

// Says what of a picture was guessed.
void note_guesses(const std::string& path, const ods::StoredPicture& picture);

// Says it where readers of the file would go by a name that misleads: y_LR.png of top-bottom.
void note_misleading_name(const std::string& output, const ods::SaveOptions& save, size_t eye_count,
                          const ods::ProjectionSetting& projection);

// Throws UsageError where `output` is the file that `input` is, by this name or another; %V stands for both eyes'.
void refuse_overwriting(const std::string& output, const std::string& input);

// Throws UsageError with a suggestion.
const ods::NamedSize& size_by_name(const std::string& name);
