// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The code that README.md shows.
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "ods/sequence/scene_camera.h"

int main() {
  ods::Scene scene = ods::load_scene("room");  // of a .glb file, ods::settle(scene) finds the unit and the viewer
  ods::StereoCamera camera = ods::camera_in({}, scene);
  camera.top = camera.bottom = ods::kUsualMerge;
  ods::RenderOptions options;
  options.width = 512;
  ods::save_picture(ods::render_cpu(scene, camera, options), camera, {}, "room_360_TB.png");
}
