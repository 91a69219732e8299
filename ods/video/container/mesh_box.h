// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Google's mesh projection of videos, `mshp`, which VR180 cameras use to describe their lenses. Source:
// google/spatial-media, "Spherical Video V2 RFC", Mesh Projection Box; "VR180 Video Format" for what cameras write.
#pragma once
#include <string_view>
#include <vector>

#include "ods/camera/direction_map.h"
#include "ods/camera/layout.h"
#include "ods/video/container/spherical.h"

namespace ods {

struct ProjectionMeshes {
  std::vector<TextureMesh> eyes;  // one for both eyes, or left and right
  bool fits_checksum = true;
};

// The body of an mshp box including version and flags, plain (`raw `) or packed (`dfl8`). Triangle lists of other
// textures than the video are skipped. Throws MalformedFile for damaged data, invalid numbers, more than 200000
// vertices.
ProjectionMeshes parse_mesh_box(std::string_view body);

// The meshes of a frame in this packing: one for each eye, with image positions in the eye's picture. For
// VideoStereo::kCustom, the halves of the frame that the eyes use follow from the meshes.
struct MeshedEyes {
  Layout layout = Layout::kSeparate;  // kSeparate for one eye
  std::vector<TextureMesh> eyes;
};
// Throws MalformedFile if meshes and stereo do not match.
MeshedEyes eyes_of_meshes(const ProjectionMeshes& meshes, VideoStereo stereo);

}  // namespace ods
