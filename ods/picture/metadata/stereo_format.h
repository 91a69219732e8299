// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the format of a picture file: layout, projection, camera. format_source.h has the sources in order of precedence;
// the caller's hints are its options, and the pixels count if the caller has examined them (ods/identify). The sidecar
// also has the maps that attributes only name. Names end in words after _ or . : those of layout_of() (_TB, _LR, _SBS,
// _OU ...), mono, 180, vr180, 360 and the names of projections, in upper or lower case, possibly followed by numbers.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/direction_map.h"
#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image_file.h"

namespace ods {

struct Sidecar;

// The format words at the end of a file's name.
struct NameWords {
  std::optional<Layout> layout;
  bool is_mono = false;
  std::string layout_word;  // with its separator: "_TB"; empty: none
  const NamedProjection* projection = nullptr;
  std::string projection_word;  // "_360"
};
NameWords read_name(const std::string& path);

// The end of the name of a picture from a renderer, by which read_name() and players know it: "_180_LR.png". Parts of
// the sphere and formats that players do not know have no word; names with %V stand for two files.
std::string name_end(const ProjectionSetting& projection, Layout layout);

// The same path with these words in place of the format words of its name: a_180.mp4 becomes a_360_TB.mp4.
std::string renamed(const std::string& path, const std::string& words);

// Where the layout comes from; those after kFile are guesses.
enum class LayoutSource { kPair, kCaller, kSidecar, kFile, kName, kPixels, kShape, kNothing };

struct LayoutGuess {
  std::optional<Layout> layout;  // none: the file holds one eye
  LayoutSource source = LayoutSource::kNothing;
  std::string reason;  // for messages: "its name ends in _TB"
};
bool is_guess(const LayoutGuess& guess);

// Guesses the layout from the file's metadata (ods:layout, or the channels of two views), else its name, else its
// shape: that of one eye, two stacked or two side by side, in whole-sphere lat-long, cube-6x1 or cube-1x6, or
// in the projection of its name. `projection`: what is known of it.
LayoutGuess guess_layout(const FileInfo& info, const std::string& path,
                         const std::optional<ProjectionSetting>& projection = {});

// What a picture's pixels show.
struct SeenFormat {
  std::optional<Layout> layout;  // none: one eye
  ProjectionSetting projection;
  std::string reason;  // for messages
};

// How wide the black bars around what a file shows are, pixels of the file.
struct Bars {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool any() const { return left > 0 || top > 0 || right > 0 || bottom > 0; }
};

// What the caller knows. It takes precedence over everything in the file.
struct FormatHint {
  bool one_eye = false;  // whatever its shape and name suggest
  std::optional<Layout> layout;
  std::optional<StereoCamera> camera;
  std::optional<ProjectionSetting> projection;  // of the camera, too
  std::vector<FisheyeLens> lenses;              // of each eye, or one for both; their projection is not ours then
  bool front_and_back = false;                  // the halves are fisheyes that look ahead and back: one eye
  Bars bars;                       // around all eyes together; their layout is no cube's and not interleaved
  std::optional<SeenFormat> seen;  // this alone does not take precedence, but over the shape
};

struct StereoFormat {
  LayoutGuess layout;
  int eye = kMono;        // which eye, if only one
  bool is_photo = false;  // a VR photo (vr_photo.h): layout kSeparate, both eyes in one file
  StereoCamera camera;
  bool has_camera = false;           // known from caller, file or sidecar; else only its projection is guessed
  bool has_ipd = false;              // likewise; GPano and envmap do not give one
  bool is_open = false;              // no word tells the layout and the projection: its shape or nothing does
  std::vector<std::string> guesses;  // for messages: "top-bottom: its name ends in _TB"
};

// %V or %v in the path stands for two files; `info` is the left one's. Throws Error(kInput): an anaglyph; an invalid
// sidecar, unless the caller knows the layout or the projection.
StereoFormat find_format(const FileInfo& info, const std::string& path, const FormatHint& known);

// False: the sidecar belongs to another picture of the same name. picture.exr and picture.png share one.
bool belongs_to(const Sidecar& sidecar, const FileInfo& info);

// The camera of a file: a camera sidecar, or a picture with its camera in its header or in a sidecar beside it. Guesses
// about a picture are added to `warnings`. Throws Error(kInput): neither kind of file, or a picture without a camera.
Sidecar open_camera(const std::string& path, std::vector<std::string>& warnings);

// Why a file's name would mislead readers, for messages: "its name ends in _LR, ...". Empty if the name agrees or says
// nothing. No `layout`: one eye.
std::string name_fault(const std::string& path, std::optional<Layout> layout, const ProjectionSetting& projection);

}  // namespace ods
