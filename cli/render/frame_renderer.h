// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders the frames of a job one after the other. Acceleration structures of static meshes are kept between frames.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/render/render_job.h"
#include "cli/render/render_still.h"
#include "ods/files/frames.h"
#include "ods/render/cpu/render.h"

struct Frame {
  int number;
  double time;       // seconds
  std::string path;  // of its file
  uint32_t seed;
};

// Frame `number` of a video. names: of the frames' files. Precondition: start_clock() has run.
Frame make_frame(uint32_t seed, const TimeOptions& time, const ods::FrameNames& names, int number);

// The file of a frame as rendered, for whoever denoises it: samples (ods/render/unfinished.h).
inline constexpr std::string_view kRawEnd = ".raw";
inline std::string raw_path(const Frame& frame) {
  return frame.path + std::string(kRawEnd);
}

// A frame as rendered, before it is denoised and saved.
struct RawFrame {
  double time;
  ods::StereoCamera camera;  // in the middle of the shutter
  ods::Picture picture;
  std::vector<std::vector<ods::Hit>> hits;  // CpuRenderer::center_hits(); empty if nothing but the camera moves
};

// What a frame will take, judged by a small picture of it.
struct SmallFrame {
  double seconds = 0.0;
  double bytes = 0.0;  // of its file
};

class FrameRenderer {
 public:
  // first: of the whole job; where its camera is, is noted before anything is rendered. The other arguments must
  // outlive this object.
  FrameRenderer(const RenderJob& job, const TimeOptions& time, ods::Scene& scene, Frame first);

  // Renders, denoises and saves. report: gets the fraction done, if it is set.
  Rendered render(const Frame& frame, const std::function<void(double done)>& report);

  // The exposure that the job asks for: a number of stops, or what suits its light (ods/stage/exposure.h) by a first
  // look at some of `frames`: all of the video, whatever exists already, or the one picture. It depends on the job
  // alone, so processes that share the frames or resume them find the same; --brighter is added. 0 where files keep the
  // scene's light, and for built-in scenes in their own light, which are made for it. Notes what it chose; warns if all
  // is black. What is rendered from then on is as clean as asked for when it is shown with that exposure; files that
  // keep the scene's light, with the one that they would be shown with.
  float find_exposure(const std::vector<Frame>& frames);

  // The merge map of --merge auto, by what is seen in some of `frames`, in all of them as find_exposure() has them.
  // Notes what it chose. Precondition: the job asks for it.
  ods::Image find_merge(const std::vector<Frame>& frames);

  // Says once, before a long rendering, if something in some of `frames` strains the viewer's eyes to an error.
  void warn_of_strain(const std::vector<Frame>& frames);

  // Reads what keep_raw() has written, if it is there; else renders.
  RawFrame render_raw(const Frame& frame, const std::function<void(double done)>& report);

  // Renders, and writes raw_path(frame).
  void keep_raw(const Frame& frame, const std::function<void(double done)>& report);

  // Renders a small picture of a frame, denoises and saves it there.
  SmallFrame try_small(const Frame& frame, const std::string& path);

  // As FrameBeside::places: where the surfaces of a frame are at another time.
  std::vector<std::vector<ods::vec3>> places(const RawFrame& frame, double seconds);

 private:
  void say_where() const;
  ods::Picture first_look(const Frame& frame);
  float choose_exposure(const std::vector<Frame>& frames);
  std::vector<ods::StereoCamera> set_time(const Frame& frame);
  ods::RenderOptions options_for(const Frame& frame, const ods::StereoCamera& camera) const;

  const RenderJob& job_;
  const TimeOptions& time_;
  ods::Scene& scene_;
  Frame first_;
  ods::SceneChange change_;  // since renderer_ was updated
  std::optional<ods::CpuRenderer> renderer_;
  float exposure_ = 0.0f;        // of find_exposure()
  float noise_exposure_ = 0.0f;  // with which the noise is judged
};
