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
//     "fallback": "room_360_TB.png", // a stereo picture in the same folder; absent if there is none
//     "scene": "room",             // the name of the scene that was baked, without folders; absent if unknown
//     "light": {                   // of real-time objects in it
//       "exposure": 0.5,           // stops, and
//       "tone": "neutral",         // a name of kToneCurveTable: of all textures
//       "probes": {"origin": [x, y, z], "step": [x, y, z], "count": [nx, ny, nz], "bufferView": 7}  // absent: none
//     },
//     "film": {                    // absent if nothing moves
//       "lights": [0, 0.25, 0.5],  // seconds: LayerFilm::light_times
//       "changes": [9, 10, 11]     // the numbers of the textures of LightChange::ratios; absent: nothing changes
//     }
//   }}}
//
// The buffer view has 28 little-endian floats for each of LightProbes::probes, not compressed: its weight, then 9
// coefficients of R, G and B.
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
  std::string scene;     // as LayeredScene::name
  LayerLightInfo light;  // its probes' places, without their light
};

// Reads the start of a file, not its meshes. Empty if it is not a GLB, or one without this metadata, which may still be
// a scene. Throws Error(kInput) if the file cannot be read, or if the metadata is invalid or of a newer version.
std::optional<LayersInfo> read_layers_info(const std::string& path);

// The value of "omnistereo". probes: the number of the buffer view with their light; none if there are no probes.
Json layers_metadata(const LayeredScene& scene, std::optional<size_t> probes = {});

}  // namespace ods
