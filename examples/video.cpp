// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders a stereo 360 video through the library: video [SCENE [VIDEO]]. Run it again after an interruption to resume.
#include <cstdio>
#include <numeric>

#include "ods/base/error.h"
#include "ods/camera/camera_move.h"
#include "ods/scene/load/load.h"
#include "ods/sequence/render_video.h"

int main(int argc, char** argv) try {
  const std::string name = argc > 1 ? argv[1] : "room";
  ods::Scene scene = ods::load_scene(name);
  ods::play(scene.animation, "");  // all animations of the file

  ods::StereoCamera camera;
  const ods::ViewPoint view = ods::default_view(scene);
  camera.position = view.position, camera.yaw = view.yaw;
  ods::CameraMove move;
  move.seconds = 1.0, move.fly_to = {camera.position + ods::vec3(0.5f, 0.0f, 0.0f)};

  ods::SequenceOptions options;
  options.camera = [&](const ods::Scene&, double seconds) { return ods::moved(camera, move, seconds); };
  options.shutter = 180.0;
  options.render.width = 256, options.render.samples = 4;

  ods::VideoOptions video;
  video.frames.resize(4);
  std::iota(video.frames.begin(), video.frames.end(), 0);
  video.settings = {{"scene", name, ""}};  // rejects the frames of another scene
  ods::Progress progress;
  progress.report = [](double done) { std::fprintf(stderr, "%3.0f %%\r", 100.0 * done); };
  ods::render_video(scene, options, video, argc > 2 ? argv[2] : "room_360_TB.mp4", progress);
} catch (const ods::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
