// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders a stereo 360 video through the library: video [SCENE [VIDEO]]. Run it again after an interruption to resume.
#include <cstdio>
#include <numeric>

#include "ods/base/error.h"
#include "ods/scene/load/load.h"
#include "ods/sequence/identity.h"
#include "ods/sequence/render_video.h"

int main(int argc, char** argv) try {
  const std::string name = argc > 1 ? argv[1] : "room";
  ods::Scene scene = ods::load_scene(name);
  ods::play(scene.animation, "");  // all animations of the file

  ods::SequenceOptions options;
  options.scene = ods::scene_settings(name);  // the frames of another scene are refused
  options.camera.move.seconds = 1.0;
  options.camera.move.fly_to = {ods::default_view(scene).position + ods::vec3(0.5f, 0.0f, 0.0f)};
  options.shutter = 180.0;
  options.render.width = 256;
  options.render.samples = 4;

  ods::VideoOptions video;
  video.frames.resize(4);
  std::iota(video.frames.begin(), video.frames.end(), 0);
  ods::Progress progress;
  progress.report = [](double done) { std::fprintf(stderr, "%3.0f %%\r", 100.0 * done); };
  ods::render_video(scene, options, video, argc > 2 ? argv[2] : "room_360_TB.mp4", progress);
} catch (const ods::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
