// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A rendered view of a rig of slits, looked into along rays of the picture that is put together.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/image/reproject.h"
#include "ods/image/resample.h"
#include "ods/image/save.h"
#include "ods/stitch/slit_rig.h"

namespace ods {

// What all views of a rig have: their layers, channel behind channel.
struct ViewForm {
  std::vector<RowLayer> layers;
  size_t channels = 0;
  std::vector<char> is_nearest;  // of every channel: never averaged
  int depth = -1;                // the channel of metres; below 0: there is none
};
ViewForm form_of(const StoredPicture& picture);
bool same_layers(const ViewForm& a, const ViewForm& b);

class View {
 public:
  // `pose`: where it stood and looked. Its depth, if it has any and the rig says which, becomes that along its rays.
  View(StoredPicture picture, const CameraRig& pose, ViewDepth depth);
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  // All channels of what a ray meets, averaged over a pixel: `right` and `down` are where the pixels beside it and
  // below it look. Depth is along the ray. False: the view does not show what the ray meets, and what is far behind
  // stands in.
  bool look(const Ray& ray, vec3 right, vec3 down, std::span<float> out) const;

 private:
  void measure_along_rays(size_t layer);

  StoredPicture picture_;
  ViewForm form_;
  std::vector<float> distances_;  // in place of the depth that the file has
  Source source_;
  Resampler resampler_;
  std::optional<Reprojection> surfaces_;
  vec3 place_;
};

}  // namespace ods
