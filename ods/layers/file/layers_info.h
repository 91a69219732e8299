// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The metadata by which a GLB is known as a layered scene of ours:
//
//   "asset": {"version": "2.0", "extras": {"omnistereo": {
//     "layers": 1,                 // kLayeredVersion
//     "center": [0, 1.4, 0],       // of the head's box, metres, in the world
//     "box": [0.3, 0.3, 0.3],      // its size
//     "yaw": 0,                    // degrees to the right of -Z: where the viewer looks first
//     "width": 8192,               // of the panorama whose pixel is the unit of all errors
//     "fallback": "room_360_TB.png"  // a stereo picture in the same folder; absent if there is none
//   }}}
#pragma once
#include <optional>
#include <string>

#include "ods/base/json_reader.h"
#include "ods/layers/layered_scene.h"

namespace ods {

struct LayersInfo {
  HeadBox box;
  float yaw = 0.0f;
  int width = 0;
  std::string fallback;  // a plain name without folders
};

// Reads the start of a file, not its meshes. Empty if it is not a GLB, or one without this metadata, which may still be
// a scene. Throws Error(kInput) if the file cannot be read, or if the metadata is invalid or of a newer version.
std::optional<LayersInfo> read_layers_info(const std::string& path);

// The value of "omnistereo".
Json layers_metadata(const LayeredScene& scene);

}  // namespace ods
