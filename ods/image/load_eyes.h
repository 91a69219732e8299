// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file, ours or another program's, into one image per eye: the way back from save.h.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/image/image_file.h"
#include "ods/image/layout.h"
#include "ods/image/picture.h"

namespace ods {

struct LayoutGuess {
  std::optional<Layout> layout;  // none: the file is one eye
  std::string because;           // "its name ends in _TB", to be said to people
};

// From what the file says (ods:layout, or the channels of two views); else from the end of its name (_TB, _BT, _LR,
// _RL, _SBS, _OU and every other word of layout_of(), in capitals or not, with numbers, _360 and _180 behind it); else
// from its shape: 1:1 is top-bottom, 4:1 side-by-side, all others one eye.
LayoutGuess guess_layout(const FileInfo& info, const std::string& path);

struct LoadedEyes {
  std::vector<Image> eyes;              // linear light, 3 channels; left and right, or the only one
  std::vector<Image> variance;          // of the noise in eyes, where an EXR has variance.R, G and B; else empty
  LayoutGuess guess;                    // how the file was understood
  std::string projection = "lat-long";  // unless ods:projection says otherwise
  bool is_float = false;                // the file holds light; else what a display shows, decoded from sRGB
};

// %V or %v in the path stands for two files. A layout that is given is not guessed; kSeparate without %V takes the file
// as one eye. Squeezed eyes stay as they are stored. Throws Error(kInput): a file that cannot be read, an anaglyph, a
// size that the layout cannot have, two files of two sizes.
LoadedEyes load_eyes(const std::string& path, std::optional<Layout> layout = {});

}  // namespace ods
