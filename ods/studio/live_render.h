// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders a scene while somebody looks at it: coarse and whole at first, finer while nothing changes, and finest where
// they look. A change cancels what is being rendered.
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
  double time = 0.0;  // of the scene's animation, seconds

  bool operator==(const LiveSettings&) const = default;
};

// Where somebody looks, in the picture's frame.
struct LiveView {
  float yaw = 0.0f;  // degrees
  float pitch = 0.0f;
  float fov = 90.0f;    // horizontal, degrees
  float aspect = 1.6f;  // width over height

  bool operator==(const LiveView&) const = default;
};

// What is rendered after a frame.
struct LiveStep {
  bool is_patch = false;
  int width = 0;  // of an eye, pixels
  int samples = 0;
};

struct LiveFrame {
  int number = 0;    // of all frames, ascending
  int revision = 0;  // that set() returned
  bool is_patch = false;
  StereoCamera camera;  // of the base or of the patch
  Extent eye;
  std::vector<uint8_t> pixels;   // R, G, B as displays want them; rows from the top; the left eye, then the right one
  int samples = 0;               // of a pixel
  double seconds = 0.0;          // since the settings changed
  std::optional<LiveStep> next;  // none: nothing finer follows until something changes
};

// What a ray of an eye meets.
struct LivePick {
  vec3 point{0.0f};               // in the world
  float distance = 0.0f;          // along the ray, metres
  float disparity = 0.0f;         // between the directions in which the two eyes see the point: minutes of arc
  std::optional<vec2> places[2];  // 0..1 in the picture of the left and the right eye; none: not seen
};

// A picture with depth, and its camera. Null: there is none yet.
struct LiveSeen {
  StereoCamera camera;
  std::shared_ptr<const Picture> picture;
};

class LiveRender {
 public:
  // Starts a thread that renders with this many threads (0: all processors), which stops with the object, and rests
  // while nobody has waited for a frame for this long. The scene must outlive it, and nobody else may use it.
  LiveRender(Scene& scene, int threads, std::chrono::milliseconds rest_after = std::chrono::seconds(15));
  ~LiveRender();
  LiveRender(const LiveRender&) = delete;
  LiveRender& operator=(const LiveRender&) = delete;

  // Renders this from now on, unless it is what is rendered already. Returns the number of this revision.
  int set(const LiveSettings& settings, const LiveView& view);
  // Refines there from now on.
  void look(const LiveView& view);

  // Nothing is rendered any more, and nobody waits.
  void end();

  // The latest frame of the base or the patch with a number above this one, base first; null if there is none in time.
  std::shared_ptr<const LiveFrame> next_frame(int number, std::chrono::milliseconds patience) const;

  // Why nothing is rendered any more; empty: nothing went wrong.
  std::string fault() const;

  // What an eye (kLeft, kRight) sees in a direction of the picture's frame, in the finest picture there is; none: the
  // sky, or there is no picture yet.
  std::optional<LivePick> pick(int eye, vec3 direction) const;

  // The whole picture as it is by now.
  LiveSeen whole() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The camera of the patch for a view, and its full size: as fine as a screen of 1280 pixels shows it, at most 0.8
// million pixels for an eye. For tests.
StereoCamera patch_camera(StereoCamera camera, const LiveView& view);
Extent patch_extent(const StereoCamera& patch);

}  // namespace ods
