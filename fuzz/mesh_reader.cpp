// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the mesh projection of videos: any bytes give meshes or an error, and a mesh maps a direction to a
// position in the picture or to none.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_mesh_reader
//   build/fuzz/fuzz_mesh_reader -max_len=8192 folder/of/bodies/of/mshp/boxes
#include <cmath>
#include <cstdlib>

#include "ods/base/bytes.h"
#include "ods/video/container/mesh_box.h"

static void look_around(const ods::TextureMesh& mesh) {
  const std::shared_ptr<const ods::DirectionMap> map = make_map(mesh);
  for (int i = 0; i < 200; i++) {
    const float theta = 0.7f * static_cast<float>(i), phi = static_cast<float>(i) / 100.0f - 1.0f;
    const ods::ImagePoint point = map->place({std::sin(theta), phi, -std::cos(theta)});
    if (!point.seen) continue;
    if (!(point.uv.x >= 0.0f && point.uv.x <= 1.0f && point.uv.y >= 0.0f && point.uv.y <= 1.0f)) std::abort();
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const ods::ProjectionMeshes meshes = ods::parse_mesh_box({reinterpret_cast<const char*>(data), size});
    for (const ods::VideoStereo stereo : ods::kVideoStereos) {
      try {
        for (const ods::TextureMesh& mesh : eyes_of_meshes(meshes, stereo).eyes) look_around(mesh);
      } catch (const ods::MalformedFile&) {
      }
    }
  } catch (const ods::MalformedFile&) {
  }
  return 0;
}
