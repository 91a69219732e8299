// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the format of a picture file: layout, projection, camera. format_source.h has the sources in order of
// precedence; the caller's hints are its options, and the pixels count if the caller has examined them (ods/identify).
// The sidecar also has the maps that attributes only name. Names end in words after _ or . : those of layout_of() (_TB,
// _LR, _SBS, _OU ...), mono, 180, vr180, 360 and the names of projections, in upper or lower case, possibly followed by
// numbers.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/direction_map.h"
#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/format_source.h"

namespace ods {

struct Sidecar;

// The format suffixes at the end of a file's name.
struct NameWords {
  std::optional<Layout> layout;
  bool is_mono = false;
  std::string layout_token;  // with its separator: "_TB"; empty if there is none
  const NamedProjection* projection = nullptr;
  std::string projection_token;  // "_360"
};
NameWords read_name(const std::string& path);

// The end of the name of a rendered picture, as understood by read_name() and players: "_180_LR.png". Parts of the
// sphere and formats that players do not support have no suffix; names with %V stand for two files.
std::string name_end(const ProjectionSetting& projection, Layout layout);

// The same path with these suffixes instead of its own format suffixes: a_180.mp4 becomes a_360_TB.mp4.
std::string renamed(const std::string& path, const std::string& words);

struct LayoutGuess {
  std::optional<Layout> layout;  // not set if the file contains one eye
  FormatSource source = FormatSource::kNothing;
  std::string reason;  // for messages: "its name ends in _TB"
};
// Returns whether no option and no metadata specifies it.
bool is_guess(const LayoutGuess& guess);

// The format derived from a picture's pixels.
struct SeenFormat {
  std::optional<Layout> layout;  // not set for one eye
  ProjectionSetting projection;
  std::string reason;        // for messages
  bool denies_name = false;  // the file does not have the layout in its name
};

// The widths of the black bars around a file's picture, pixels of the file.
struct Bars {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool any() const { return left > 0 || top > 0 || right > 0 || bottom > 0; }
};

// The caller's settings. They take precedence over everything in the file.
struct FormatHint {
  bool one_eye = false;  // regardless of its aspect ratio and name
  std::optional<Layout> layout;
  std::optional<StereoCamera> camera;
  std::optional<ProjectionSetting> projection;  // also the camera's
  // For each eye, or one for both; the projection then does not apply. In pixels of the eye as players show it.
  std::vector<FisheyeLens> lenses;
  bool front_and_back = false;  // the halves are fisheyes that look ahead and back, for one eye
  std::string seen_lenses;      // for messages: how the pixels showed layout and lenses; empty if they were asked for
  Bars bars;                    // around all eyes together; the layout is not a cube's and not interleaved
  std::optional<SeenFormat> seen;  // takes precedence only over the aspect ratio
};

struct StereoFormat {
  LayoutGuess layout;
  int eye = kMono;        // the eye, if there is only one
  bool is_photo = false;  // a VR photo (vr_photo.h): layout kSeparate, both eyes in one file
  StereoCamera camera;
  bool has_camera = false;           // known from caller, file or sidecar; otherwise only its projection is guessed
  bool has_ipd = false;              // known from caller, file or sidecar; GPano and envmap do not have it
  bool front_and_back = false;       // as FormatHint::front_and_back
  bool is_open = false;              // no metadata or name specifies layout and projection; the aspect ratio may
  std::vector<std::string> guesses;  // for messages: "top-bottom: its name ends in _TB"
};

// Finds the format. %V or %v in the path stands for two files; `info` is the left one's. Throws Error(kInput) for an
// anaglyph, or an invalid sidecar, unless the caller knows the layout or the projection.
StereoFormat find_format(const FileInfo& info, const std::string& path, const FormatHint& known);

// The size of an eye as players show it: not squeezed, with square pixels. layout: not set for one eye.
Extent shown_eye(const FileInfo& info, std::optional<Layout> layout);

// A window without a shape of its own, as its name alone gives it, in the shape of that eye; any other projection as it
// is.
ProjectionSetting with_shape(ProjectionSetting setting, Extent shown);

// Returns false if the sidecar belongs to another picture of the same name. picture.exr and picture.png share one.
bool belongs_to(const Sidecar& sidecar, const FileInfo& info);

// The camera of a file: a camera sidecar, or a picture with its camera in its header or in a sidecar beside it. Guesses
// about a picture are added to `warnings`. Throws Error(kInput) for other kinds of files, and for a picture without a
// camera.
Sidecar open_camera(const std::string& path, std::vector<std::string>& warnings);

// Returns whether the shape of an eye speaks for a projection. No shape speaks for a window, which may have any.
bool is_told_by_shape(const ProjectionSetting& setting, Extent eye);

// The reason why a file's name would mislead readers, for messages: "its name ends in _LR, ...". Empty if the name
// agrees or has no format suffix. layout: not set for one eye.
std::string name_fault(const std::string& path, std::optional<Layout> layout, const ProjectionSetting& projection);

}  // namespace ods
