// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A sequence of frames: their common options, and their rendering by one process or several.
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
  Settings scene;  // identifies the scene: scene_settings() (ods/sequence/identity.h), and the settings that changed it
  SceneCamera camera;
  std::optional<float> merge_limit;  // minutes of arc: the poles are merged so that no frame strains the eyes by more
                                     // above and below (ods/comfort/merge_from_depth.h); look_first() finds how
  double fps = 30.0;
  int first_frame = 0;   // the number of the frame at 0 seconds
  double shutter = 0.0;  // shutter angle, degrees, centred on the frame's time: 360 is the time between two frames
  std::optional<bool> changing_grain;  // each frame has its own noise; nullopt: if camera.move moves
  std::optional<float> exposure;       // stops: for judging noise, and for a video; nullopt: chosen for the light
  float brighter = 0.0f;               // stops, added to the exposure, given or chosen
  RenderOptions render;  // of a picture; height 0: what suits the camera's projection. `layers` and `statistics`:
                         // whether the files have them. noise_exposure: look_first() sets it
  FinishOptions finish;
  bool draws_on_neighbours = true;               // Denoiser::kOwn also uses the neighbouring frames
  std::function<void(const std::string&)> warn;  // gets a line of text; may be empty
};

struct SequenceFrame {
  int number = 0;
  double time = 0.0;  // seconds
  std::string path;   // path of its file
  uint32_t seed = 0;
};

// Frames with these numbers, named by a pattern (ods/files/frames.h); frame f is at (f - first_frame) / fps seconds.
// Throws Error(kUsage) if the pattern has no number.
std::vector<SequenceFrame> make_frames(const SequenceOptions& options, const std::vector<int>& numbers,
                                       const std::string& pattern);

// A picture that is saved.
struct Rendered {
  std::vector<std::string> files;
  double samples = 0.0;  // total of all pixels
};

// The current frame: number `place`, counted from 1, of the frames to make.
struct FrameAtWork {
  int place = 1, count = 1;
  std::string path;
};

struct SequenceProgress {
  std::function<void(double done, const FrameAtWork& frame)> report;  // the fraction of the whole
  std::function<void(const Rendered& frame)> saved;
  // Called when this process waits for these frames, which other processes make; `holder` is one of them.
  std::function<void(const std::vector<int>& numbers, const std::string& holder)> waiting;
};

// Returns the indices of the frames in `all` with these numbers; with skip_existing only of frames that are not saved.
// Removes stale claims from these.
std::vector<size_t> choose_frames(const std::vector<SequenceFrame>& all, const std::vector<int>& numbers,
                                  bool skip_existing = true);

// The destination of rendered frames.
enum class Sink {
  kFiles,   // denoised and saved
  kShared,  // as kFiles, except for frames that other processes with the same call are making (ods/files/claim.h)
  kRaw,     // saved as rendered, in raw_path(frame), for a later process that denoises them; shared, too
};

class FrameRenderer;

// Makes the frames of `all` whose indices are `missing`. A shared frame whose process died is made here. On return all
// missing frames exist. Frames have the same bits whichever process makes them, and whatever existed before. Returns
// the number of frames made here. Throws Error: kOutput, kMemory, and anything that `progress` throws.
size_t render_sequence(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                       const std::vector<size_t>& missing, Sink sink, const SequenceProgress& progress = {});

}  // namespace ods
