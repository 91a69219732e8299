// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders the frames of a sequence one after the other. Acceleration structures of static meshes are kept between
// frames.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ods/render/renderer.h"
#include "ods/scene/motion.h"
#include "ods/sequence/sequence.h"

namespace ods {

// The extension of the file of a raw frame, for the process that denoises it: samples (ods/render/unfinished.h).
inline constexpr std::string_view kRawEnd = ".raw";
inline std::string raw_path(const SequenceFrame& frame) {
  return frame.path + std::string(kRawEnd);
}

// A frame's camera, during the shutter, and the options that render it.
struct Shot {
  std::vector<StereoCamera> cameras;
  RenderOptions options;
  const StereoCamera& camera() const { return cameras[cameras.size() / 2]; }
};

// A frame as rendered, before it is denoised and saved.
struct RawFrame {
  double time = 0.0;
  StereoCamera camera;  // in the middle of the shutter
  Picture picture;
  std::vector<std::vector<Hit>> hits;  // Renderer::center_hits(); empty if only the camera moves
};

class FrameRenderer {
 public:
  using Report = std::function<void(double done)>;

  // The scene must outlive this object.
  FrameRenderer(SequenceOptions options, Scene& scene) : options_(std::move(options)), scene_(scene) {}

  const SequenceOptions& options() const { return options_; }
  void set_options(SequenceOptions options) { options_ = std::move(options); }  // applies to the following frames
  const Scene& scene() const { return scene_; }

  // Returns whether frames are denoised together with their neighbours.
  bool draws_on_neighbours() const;

  // Sets the scene to the frame's time.
  Shot set(const SequenceFrame& frame);

  // The scene as set. Precondition: set() has been called.
  const Renderer& renderer() const { return *renderer_; }

  // Renders, denoises and saves. report: gets the fraction done, if it is set.
  Rendered render(const SequenceFrame& frame, const Report& report = {});

  // Reads the file that keep_raw() has written, if it exists; otherwise renders. Warns if the file is unusable.
  RawFrame render_raw(const SequenceFrame& frame, const Report& report = {});

  // Renders, and writes raw_path(frame).
  Rendered keep_raw(const SequenceFrame& frame, const Report& report = {});

  // Returns FrameBeside::places: the places of a frame's surfaces at another time.
  std::vector<std::vector<vec3>> places(const RawFrame& frame, double seconds);

 private:
  std::optional<Picture> read_raw(const std::string& path, const RenderOptions& options) const;

  SequenceOptions options_;
  Scene& scene_;
  SceneChange change_;  // since renderer_ was updated
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace ods
