// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders a scene through the library: room [PICTURE [WIDTH [SAMPLES]]]
#include <cstdio>
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"

int main(int argc, char** argv) try {
  ods::Scene scene = ods::load_scene("room");  // or a .glb file
  if (!ods::has_light(scene)) scene.environment.radiance = ods::vec3(1.0f);

  const ods::ViewPoint view = ods::default_view(scene);
  ods::StereoCamera camera;
  camera.position = view.position;
  camera.yaw = view.yaw;

  ods::RenderOptions options;
  options.width = argc > 2 ? std::atoi(argv[2]) : 1024;
  options.samples = argc > 3 ? std::atoi(argv[3]) : 16;

  const ods::Picture picture = ods::render_cpu(scene, camera, options);
  ods::save_picture(picture, camera, {}, argc > 1 ? argv[1] : "room.png");
} catch (const ods::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
