// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera sidecar: all data of a picture's camera as JSON, beside the picture. docs/camera-sidecar.md has the
// schema. Values round-trip bit for bit.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"

namespace ods {

// The number in "omnistereo_camera". It increases when older readers would misunderstand newer files.
inline constexpr int kSidecarVersion = 1;

// Maximum number of texels of a merge map or a head-tilt map.
inline constexpr int64_t kLargestMap = 1 << 24;

struct Sidecar {
  StereoCamera camera;
  Extent eye;  // pixels of one eye as rendered; 0x0 if the file does not specify it
  Layout layout = Layout::kTopBottom;
  std::vector<int> eyes{kLeft, kRight};  // as in EyeImage
};

std::string write_sidecar(const Sidecar& file);

// `name` stands for the text in messages. Unknown keys add to `warnings`; missing keys keep the defaults of
// StereoCamera. Throws Error(kInput) if the text is not JSON, of a newer version, or has a value of the wrong type or
// out of range.
Sidecar read_sidecar(std::string_view text, const std::string& name, std::vector<std::string>& warnings);
Sidecar load_sidecar(const std::string& path, std::vector<std::string>& warnings);

// Writes the file atomically. Throws Error(kOutput).
void save_sidecar(const Sidecar& file, const std::string& path);

// picture.png -> picture.camera.json; an eye's placeholder (%V) is dropped with its separator.
std::string sidecar_path(const std::string& picture);

}  // namespace ods
