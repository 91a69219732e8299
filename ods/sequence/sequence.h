// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A sequence of frames: what all of them have in common, and how they are rendered, alone or by several processes.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ods/base/settings.h"
#include "ods/render/render_options.h"
#include "ods/sequence/finish_picture.h"
#include "ods/sequence/scene_camera.h"

namespace ods {

// A new member needs its row in ods/sequence/identity.cpp.
struct SequenceOptions {
  Settings scene;  // what the scene was made of: scene_settings() (ods/sequence/identity.h), and what has changed it
  SceneCamera camera;
  std::optional<float> merge_limit;  // minutes of arc: the poles are merged so that no frame strains the eyes by more
                                     // above and below (ods/comfort/merge_from_depth.h); look_first() finds how
  double fps = 30.0;
  double shutter = 0.0;  // shutter angle, degrees, centred on the frame's time: 360 is the time between two frames
  std::optional<bool> changing_grain;  // each frame has noise of its own; nullopt: if camera.move moves
  std::optional<float> exposure;       // stops: noise is judged at it, and a video shown; nullopt: what suits the light
  float brighter = 0.0f;               // of all frames, and these stops more
  RenderOptions render;  // of a picture; height 0: what suits the camera's projection. `layers` and `statistics`:
                         // whether the files have them. noise_exposure: look_first() sets it
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

// Frames with these numbers, named by a pattern (ods/files/frames.h); frame f is at f / fps seconds. Throws
// Error(kUsage): no number in the pattern.
std::vector<SequenceFrame> make_frames(const SequenceOptions& options, const std::vector<int>& numbers,
                                       const std::string& pattern);

// A picture that is saved.
struct Rendered {
  std::vector<std::string> files;
  double samples = 0.0;  // in all pixels together
};

// The frame at work: the place-th of those that are to be made, from 1.
struct FrameAtWork {
  int place = 1, count = 1;
  std::string path;
};

struct SequenceProgress {
  std::function<void(double done, const FrameAtWork& frame)> report;  // the fraction of the whole
  std::function<void(const Rendered& frame)> saved;
  // Other processes are making these frames, one of them is `holder`: their frames are waited for.
  std::function<void(const std::vector<int>& numbers, const std::string& holder)> waiting;
};

// Indices of those of `all` with these numbers; skip_existing: that are not saved. Removes stale claims from these.
std::vector<size_t> choose_frames(const std::vector<SequenceFrame>& all, const std::vector<int>& numbers,
                                  bool skip_existing = true);

// What becomes of rendered frames.
enum class Sink {
  kFiles,   // denoised and saved
  kShared,  // the same, except for frames that other processes with the same call are making (ods/files/claim.h)
  kRaw,     // saved as rendered, in raw_path(frame), for a later process that denoises them; shared, too
};

class FrameRenderer;

// Makes those of the frames `all` that are `missing`, by their indices. A shared frame whose process died is made here.
// On return all of the missing ones exist. Frames have the same bits whichever process makes them, and whatever existed
// before. Returns how many were made here. Throws Error: kOutput, kMemory, and what `progress` throws.
size_t render_sequence(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                       const std::vector<size_t>& missing, Sink sink, const SequenceProgress& progress = {});

}  // namespace ods
