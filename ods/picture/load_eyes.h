// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file, ours or another program's, into one image per eye: the way back from save.h.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/picture/picture.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct LoadedEyes {
  std::vector<Image> eyes;              // linear light, 3 channels; left and right, or the only one
  std::vector<Image> variance;          // of the noise in eyes, where an EXR has variance.R, G and B; else empty
  LayoutGuess guess;                    // how the file was understood
  std::string projection = "lat-long";  // by its name, as find_format() has it
  bool is_float = false;                // the file holds light; else what a display shows, which is decoded
  std::string color_fault;              // as StoredPicture has it
};

// %V or %v in the path stands for two files. A layout that is given is not guessed; kSeparate without %V takes the file
// as one eye. Squeezed eyes stay as they are stored; alpha is left out. Throws as open_picture().
LoadedEyes load_eyes(const std::string& path, std::optional<Layout> layout = {});

// The luminance of a picture's eyes, 1 channel of linear light; NaN and infinity as they are there.
std::vector<Image> grey_eyes(const StoredPicture& picture);

}  // namespace ods
