// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A sequence of frames: what all of them have in common, and how they are rendered, alone or by several processes.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/render/render_options.h"
#include "ods/scene/scene.h"
#include "ods/sequence/finish_picture.h"

namespace ods {

struct SequenceOptions {
  // The camera at a time, in seconds; the scene is as it is then. Required.
  std::function<StereoCamera(const Scene& scene, double seconds)> camera;
  double fps = 30.0;
  int first_frame = 0;   // the number of the frame at 0 seconds
  double shutter = 0.0;  // shutter angle, degrees, centred on the frame's time: 360 is the time between two frames
  RenderOptions render;  // of a picture; height 0: what suits the camera's projection. `layers` and `statistics`:
                         // whether the files have them
  FinishOptions finish;
  bool draws_on_neighbours = true;               // the own denoiser also looks at the frames beside a frame
  std::function<void(const std::string&)> warn;  // gets a line of text; may be empty
};

struct SequenceFrame {
  int number = 0;
  double time = 0.0;  // seconds
  std::string path;   // of its file
  uint32_t seed = 0;
};

// Frames with these numbers, named by a pattern (ods/files/frames.h); frame f is at (f - first_frame) / fps seconds. changing_grain:
// each has noise of its own; else all have that of options.render.seed. Throws Error(kUsage): no number in the pattern.
std::vector<SequenceFrame> make_frames(const SequenceOptions& options, const std::vector<int>& numbers,
                                       const std::string& pattern, bool changing_grain = true);

// A picture that is saved.
struct Rendered {
  std::vector<std::string> files;
  double samples = 0.0;  // in all pixels together
};

struct SequenceProgress {
  // The fraction of the whole, and the frame at work, as an index.
  std::function<void(double done, size_t index)> report;
  std::function<void(const Rendered& frame)> saved;
  // Other processes are making these frames, one of them is `holder`: their frames are waited for.
  std::function<void(const std::vector<int>& numbers, const std::string& holder)> waiting;
};

class FrameRenderer;

// Renders, denoises and saves those of the frames `all` that are `missing`, by their indices. shared: except those that
// other processes with the same call are making; a frame whose process died is made here (ods/files/claim.h). On return
// all of the missing ones exist. Frames have the same bits whoever makes them, and whatever existed before. Returns how
// many were made here. Throws Error: kOutput, kMemory, and what `progress` throws.
size_t render_sequence(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                       const std::vector<size_t>& missing, bool shared, const SequenceProgress& progress = {});

// The frames as rendered, for a later process that denoises them: samples, in raw_path(frame). Always shared.
void render_raw_sequence(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                         const std::vector<size_t>& missing, const SequenceProgress& progress = {});

}  // namespace ods
