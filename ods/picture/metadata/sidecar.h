// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera sidecar: everything about a picture's camera as JSON, beside the picture. docs/camera-sidecar.md has the
// schema. What is written is read back bit for bit.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"

namespace ods {

// The number in "omnistereo_camera". It grows when a reader of the old number would misunderstand a file.
inline constexpr int kSidecarVersion = 1;

struct Sidecar {
  StereoCamera camera;
  Extent eye;  // pixels of one eye's picture as it was rendered, 0x0 when the file does not say
  Layout layout = Layout::kTopBottom;
  std::vector<int> eyes{kLeft, kRight};  // as EyeImage has them
};

std::string write_sidecar(const Sidecar& file);

// `name` stands for the text in messages. Keys that we do not know are named in `warnings`; keys that are missing leave
// the defaults of StereoCamera. Throws Error(kInput): not JSON, a newer version, a value of the wrong kind or out of
// range.
Sidecar read_sidecar(std::string_view text, const std::string& name, std::vector<std::string>& warnings);
Sidecar load_sidecar(const std::string& path, std::vector<std::string>& warnings);

// Complete or not at all. Throws Error(kOutput).
void save_sidecar(const Sidecar& file, const std::string& path);

// picture.png -> picture.camera.json; a place for the eye (%V) goes with what stands around it.
std::string sidecar_path(const std::string& picture);

}  // namespace ods
