// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads any picture file into one image per eye: the inverse of save.h.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/picture/picture.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct LoadedEyes {
  std::vector<Image> eyes;      // linear light, 3 channels; left and right, or just one
  std::vector<Image> variance;  // variance of the noise in `eyes`, if an EXR has variance.R, G and B; else empty
  LayoutGuess guess;            // source of the layout
  std::string projection = "lat-long";  // by name, as found by find_format()
  bool is_float = false;                // scene-linear file; else display-encoded, and decoded here
  std::string color_fault;              // as in StoredPicture
};

// A path with %V or %v names two files. If `layout` is given, it is not guessed; kSeparate without %V reads the file as
// one eye. Squeezed eyes remain squeezed; alpha is dropped. Throws the same errors as open_picture().
LoadedEyes load_eyes(const std::string& path, std::optional<Layout> layout = {});

// Passes the rows of an eye to `put`, from the top: red, green and blue of each pixel in linear light; NaN and infinity
// are kept. eye: index in StoredPicture::eyes.
void read_colors(const StoredPicture& picture, size_t eye,
                 const std::function<void(int y, const std::vector<float>& row)>& put);

// The luminance of a picture's eyes: 1 channel, linear; NaN and infinity are kept.
std::vector<Image> grey_eyes(const StoredPicture& picture);

}  // namespace ods
