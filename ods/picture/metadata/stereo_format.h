// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What form a picture file has: which layout, which projection, which camera. From what the caller knows, else from
// what stands beside it (NAME.camera.json), in it (ods:*, GPano, envmap, the channels of two views, a
// second eye) or in its name,
// else from its shape. Names end in words with _ or . before them: those of layout_of() (_TB, _LR, _SBS, _OU ...),
// mono, 180, vr180, 360 and the names of projections, in capitals or not, with numbers behind them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image_file.h"

namespace ods {

struct Sidecar;

// The words that a file's name ends in.
struct NameWords {
  std::optional<Layout> layout;
  bool is_mono = false;
  std::string layout_word;  // with the mark before it: "_TB"; empty where there is none
  const NamedProjection* projection = nullptr;
  std::string projection_word;  // "_360"
};
NameWords read_name(const std::string& path);

// The same path with a name that ends in these words in place of those that it ends in: a_180.mp4 becomes a_360_TB.mp4.
std::string renamed(const std::string& path, const std::string& words);

// Who says how the eyes share a file; those behind kFile are guesses.
enum class LayoutSource { kPair, kCaller, kSidecar, kFile, kName, kShape, kNothing };

struct LayoutGuess {
  std::optional<Layout> layout;  // none: the file is one eye
  LayoutSource source = LayoutSource::kNothing;
  std::string reason;  // "its name ends in _TB", to be said to people
};
bool is_guess(const LayoutGuess& guess);

// From what the file says (ods:layout, or the channels of two views), else its name, else its shape: that of a whole
// sphere in lat-long, cube-3x2, cube-6x1 or cube-1x6, or of what its name says; one eye, two stacked or two beside each
// other. `projection`: what is known of it.
LayoutGuess guess_layout(const FileInfo& info, const std::string& path,
                         const std::optional<ProjectionSetting>& projection = {});

// What the caller knows goes before all that the file says.
struct FormatHint {
  bool one_eye = false;  // whatever its shape and name may say
  std::optional<Layout> layout;
  std::optional<StereoCamera> camera;
  std::optional<ProjectionSetting> projection;  // of the camera, too
};

struct StereoFormat {
  LayoutGuess layout;
  int eye = kMono;        // which, of one
  bool is_photo = false;  // a Cardboard photo (cardboard.h): layout kSeparate, both eyes in one file
  StereoCamera camera;
  bool has_camera = false;           // by the caller, the file or its sidecar; else only its projection is a guess
  bool has_ipd = false;              // likewise; GPano and envmap are no words on it
  std::vector<std::string> guesses;  // "top-bottom: its name ends in _TB", to be said to people
};

// %V or %v in the path stands for two files, of which `info` is the left one's. Throws Error(kInput): an anaglyph; a
// sidecar that is none, unless the caller knows the layout or the projection.
StereoFormat find_format(const FileInfo& info, const std::string& path, const FormatHint& known);

// The camera of a file, whichever it is: a camera sidecar, or a picture that carries its camera in its header or in a
// sidecar beside it. What was guessed about a picture is in `warnings`. Throws Error(kInput): neither, or a picture
// without a camera.
Sidecar open_camera(const std::string& path, std::vector<std::string>& warnings);

// What a file's name would make readers believe that is not so, in words for people: "its name ends in _LR, ...".
// Empty where it agrees or says nothing. `layout`: none of one eye.
std::string name_fault(const std::string& path, std::optional<Layout> layout, const ProjectionSetting& projection);

}  // namespace ods
