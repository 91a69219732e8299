// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Google's mesh projection of videos, `mshp`, in which VR180 cameras describe their lenses. Source:
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
// textures than the video are skipped. Throws MalformedFile: damaged, numbers that are none, more than 200000 vertices.
ProjectionMeshes parse_mesh_box(std::string_view body);

// The meshes of a frame that packs its eyes so: one for each eye, whose image positions are in the eye's picture. With
// VideoStereo::kCustom, the meshes themselves tell where in the frame the eyes are: in halves.
struct MeshedEyes {
  Layout layout = Layout::kSeparate;  // kSeparate: one eye
  std::vector<TextureMesh> eyes;
};
// Throws MalformedFile: meshes and stereo do not fit.
MeshedEyes eyes_of_meshes(const ProjectionMeshes& meshes, VideoStereo stereo);

}  // namespace ods
