// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads any picture file into one image per eye: the inverse of save.h.
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
  std::vector<Image> eyes;              // linear light, 3 channels; left and right, or just one
  std::vector<Image> variance;          // of the noise in `eyes`, if an EXR has variance.R, G and B; else empty
  LayoutGuess guess;                    // by name, as find_format() finds it
  std::string projection = "lat-long";  // scene-linear file; else display-encoded, and decoded here
  bool is_float = false;                // as in StoredPicture
  std::string color_fault;              // as StoredPicture has it
};

// %V or %v in the path stands for two files. A given layout is not guessed; kSeparate without %V reads the file as one
// eye. Squeezed eyes stay squeezed; alpha is dropped. Throws as open_picture().
LoadedEyes load_eyes(const std::string& path, std::optional<Layout> layout = {});

// The luminance of a picture's eyes: 1 channel, linear; NaN and infinity are kept.
std::vector<Image> grey_eyes(const StoredPicture& picture);

}  // namespace ods
