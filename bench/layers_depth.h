// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers that are made of a picture with depth instead of the scene.
#pragma once
#include <string>

#include "bench/layers_views.h"
#include "ods/files/private_folder.h"
#include "ods/kernel/camera/camera.h"
#include "ods/layers/as_scene.h"
#include "ods/layers/depth/picture_layers.h"
#include "ods/picture/save.h"

namespace ods {

// A lat-long picture of the scene's unlit colours, with depth. ipd: metres; 0 for a picture of one eye.
inline StoredPicture picture_with_depth(const Colours& truth, const HeadBox& box, int width, float ipd) {
  StereoCamera camera;
  camera.position = box.center;
  camera.ipd = ipd;
  const Camera record = make_camera(camera);
  Picture picture;
  for (const int eye : eye_list(ipd > 0.0f ? Eyes::kBothEyes : Eyes::kMonoEye)) {
    EyeImage& image = picture.eyes.emplace_back();
    image.eye = eye;
    image.radiance = Image(width, width / 2, 3);
    image.depth = Image(width, width / 2, 1);
    tbb::parallel_for(0, width / 2, [&](int y) {
      for (int x = 0; x < width; x++) {
        const auto ray_at = [&](float right, float down) {
          return camera_ray(record, eye,
                            {(static_cast<float>(x) + right) / static_cast<float>(width),
                             (static_cast<float>(y) + down) / static_cast<float>(width / 2)});
        };
        vec3 sum(0.0f);
        bool met = false;
        for (int k = 0; k < 4; k++) {
          sum += truth.at(ray_at(0.25f + 0.5f * static_cast<float>(k % 2), 0.25f + 0.5f * static_cast<float>(k / 2)),
                          false, met);
        }
        for (int c = 0; c < 3; c++) image.radiance.at(x, y)[c] = 0.25f * sum[c];
        float distance = kFarDepth;
        truth.at(ray_at(0.5f, 0.5f), false, met, &distance);
        image.depth.at(x, y)[0] = met ? distance : kFarDepth;
      }
    });
  }
  const PrivateFolder folder;
  const std::string path = std::string(folder.path()) + "/picture.exr";
  save_picture(picture, camera, {}, path);
  return open_picture(path);
}

// As the colours of the scene are: displayed without a tone curve.
inline Scene scene_of_depth(const Colours& truth, const HeadBox& box, int width, float ipd, std::string& about) {
  const StoredPicture picture = picture_with_depth(truth, box, width, ipd);
  PictureLayersOptions options;
  options.tone = ToneCurve::kLinear;
  PictureLayersCounts counts;
  const LayeredScene layers = picture_layers(picture, options, &counts);
  about = fmt::format("{} triangles, {} meshes, hidden {:.2f} %, open {:.3f} %", counts.triangles, layers.meshes.size(),
                      100.0 * counts.hidden, 100.0 * counts.open);
  return as_scene(layers);
}

}  // namespace ods
