// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders a scene interactively: coarse and whole at first, finer while nothing changes, and finest in the current
// view. A change cancels the rendering in progress.
//
// The whole picture (base) has the camera's own projection. The part in view (patch) is a lat-long window of the same
// camera: both contain the same lines of sight, so that a display can put the patch over the base.
#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/base/extent.h"
#include "ods/image/tone.h"
#include "ods/picture/picture.h"
#include "ods/scene/scene.h"

namespace ods {

struct LiveSettings {
  StereoCamera camera;
  float exposure = 0.0f;  // stops
  ToneCurve tone = ToneCurve::kNeutral;
  double time = 0.0;                 // time of the scene's animation, seconds
  std::optional<float> merge_limit;  // minutes of arc: depth decides on the camera's merges, as --merge auto does

  bool operator==(const LiveSettings&) const = default;
};

// The direction of the view, in the picture's frame.
struct LiveView {
  float yaw = 0.0f;  // degrees
  float pitch = 0.0f;
  float fov = 90.0f;    // horizontal, degrees
  float aspect = 1.6f;  // width over height

  bool operator==(const LiveView&) const = default;
};

// The step of rendering that follows a frame.
struct LiveStep {
  bool is_patch = false;
  int width = 0;  // width of an eye, pixels
  int samples = 0;
};

struct LiveFrame {
  int number = 0;    // number of the frame, ascending
  int revision = 0;  // returned by set()
  bool is_patch = false;
  StereoCamera camera;  // camera of the base or of the patch
  Extent eye;
  std::vector<uint8_t> pixels;   // R, G, B as display values; rows from the top; the left eye, then the right one
  int samples = 0;               // per pixel
  double seconds = 0.0;          // since the settings changed
  std::optional<LiveStep> next;  // not set if the picture gets no finer until something changes
};

// The hit of a ray of an eye.
struct LivePick {
  vec3 point{0.0f};               // in the world
  float distance = 0.0f;          // along the ray, metres
  float disparity = 0.0f;         // between the directions in which the two eyes see the point: arc minutes
  std::optional<vec2> places[2];  // 0..1 in the picture of the left and the right eye; not set if not visible
};

// A picture with depth, and its camera. Null if not rendered yet.
struct LiveSeen {
  StereoCamera camera;
  std::shared_ptr<const Picture> picture;
};

class LiveRender {
 public:
  // Starts a thread that renders with this many threads (0 for all processors). It stops with the object, and pauses
  // when no frame was requested for `rest_after`. The scene must outlive it, and must not be used elsewhere.
  LiveRender(Scene& scene, int threads, std::chrono::milliseconds rest_after = std::chrono::seconds(15));
  ~LiveRender();
  LiveRender(const LiveRender&) = delete;
  LiveRender& operator=(const LiveRender&) = delete;

  // Renders these settings from now on, unless they are rendered already. Returns the number of this revision.
  int set(const LiveSettings& settings, const LiveView& view);
  // Refines in this view from now on.
  void look(const LiveView& view);

  // Stops rendering, and wakes all waiting threads.
  void end();

  // The latest frame of the base or the patch with a number above this one, base first; null if there is none within
  // `patience`.
  std::shared_ptr<const LiveFrame> next_frame(int number, std::chrono::milliseconds patience) const;

  // The error that ended rendering. Empty if there was none.
  std::string fault() const;

  // The point that an eye (kLeft, kRight) sees in a direction of the picture's frame, in the finest existing picture.
  // Returns nullopt for the sky, or if there is no picture yet.
  std::optional<LivePick> pick(int eye, vec3 direction) const;

  // The present state of the whole picture.
  LiveSeen whole() const;

  // The camera of the present settings, with its merge by depth if they have a limit. Waits for the render thread;
  // throws Error(kInput) if that has ended with an error.
  StereoCamera camera() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The camera of the patch for a view, and its full size: the resolution of a screen of 1280 pixels, at most 0.8 million
// pixels per eye. For tests.
StereoCamera patch_camera(StereoCamera camera, const LiveView& view);
Extent patch_extent(const StereoCamera& patch);

}  // namespace ods
