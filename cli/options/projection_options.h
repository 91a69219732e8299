// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that state a picture's projection, shared by the commands that make or read one.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/options.h"
#include "ods/camera/projection.h"
#include "ods/identify/open_media.h"

// The options that change a projection; fields that are absent do not change it.
struct ProjectionChanges {
  std::optional<ods::ProjectionSetting> named;  // by --projection
  std::optional<ods::ProjectionSetting> face;   // by --face: perspective, with its direction
  std::optional<std::vector<float>> range;      // --range: 2 or 4 numbers
  std::optional<float> fov;
  std::optional<std::vector<float>> polynomial;  // --lens-polynomial
  std::optional<ods::vec2> sensor;
  std::optional<ods::vec2> direction;  // --lens-direction: pan and tilt
  bool any() const { return named || face || range || fov || polynomial || sensor || direction; }
};

// option: the name of the one that names the projection, perhaps with a short form: "--to-projection,--to".
void add_projection_options(Options& options, ProjectionChanges& changes, const std::string& option = "--projection");

// Throws UsageError for an option that the resulting projection does not have.
ods::ProjectionSetting changed(ods::ProjectionSetting projection, const ProjectionChanges& changes);

// Throws UsageError with a message that names `option` and the value.
ods::ProjectionSetting projection_by_name(const std::string& option, const std::string& name);

// Finds the height of one eye's picture if it is 0, or else the aspect of a perspective view. Throws UsageError if the
// numbers do not fit together.
void finish_projection(ods::ProjectionSetting& projection, int width, int& height);

// Options for files that show a camera's own fisheyes: --front-and-back and --circle.
void add_lens_options(Options& options, ods::FormatHint& known);

// Sets the format that these options imply: a fisheye, and two halves if the lenses look ahead and back.
void finish_lens_options(ods::FormatHint& known);

// The files of one input: adds the argument, and finds what belongs together by ods::find_input() after parse(), with
// its notes. `known`: settings of the caller, which make one file stand alone.
void add_input_argument(Options& options, const ValueKind& kind, std::vector<std::string>& files,
                        const std::string& text);
std::string joined_input(const std::vector<std::string>& files, const ods::FormatHint& known);

// Opens an input by ods::open_media(), and prints its notes. Throws ods::Error like it and ods::refuse_unlikely().
ods::MediaFile open_input(const std::string& path, const ods::MediaOptions& options);
