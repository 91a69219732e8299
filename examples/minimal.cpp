// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The code that README.md shows.
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"

int main() {
  ods::Scene scene = ods::load_scene("room");  // or the path of a .glb file
  ods::StereoCamera camera;
  const ods::ViewPoint view = ods::default_view(scene);
  camera.position = view.position, camera.yaw = view.yaw;
  ods::RenderOptions options;
  options.width = 512;
  ods::save_picture(ods::render_cpu(scene, camera, options), camera, {}, "room_360_TB.png");
}
