// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Blender, which has opened a file and renders pictures of it with Cycles and our camera, one eye at a time
// (blender/omnistereo/bridge/cycles.py).
#pragma once
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/programs.h"
#include "ods/base/extent.h"
#include "ods/camera/stereo_camera.h"
#include "ods/files/private_folder.h"

// A file as Blender has opened it.
struct CyclesScene {
  ForeignScene foreign;  // without a file, a world and an environment
  std::string blender;   // its version
  double now = 0.0;      // the frame at which it was saved
  double fps = 24.0;
  int samples = 0;        // its own, per pixel
  float exposure = 0.0f;  // stops, of its colour management
  std::string view;       // its view transform: "Filmic"
  bool transparent = false;
  std::string camera;  // of the saved frame, by name; empty: it has none
};

// The place from which a shot is rendered.
struct CyclesPose {
  ods::vec3 position{0.0f};
  float yaw = 0.0f;  // degrees
};

// One eye's picture, or a part of its samples.
struct CyclesShot {
  double frame = 0.0;  // of the file
  int eye = ods::kLeft;
  ods::Extent size;
  ods::StereoCamera camera;                 // lat-long, whole or a part; cycles_lacks() is empty
  std::optional<ods::vec3> position;        // absent: that of the file's camera
  std::optional<float> yaw;                 // degrees; absent: that of the file's camera
  std::optional<CyclesPose> before, after;  // a frame earlier and later, for motion blur; absent: as at the frame
  std::string device;                       // cpu, gpu, auto; empty: the file's
  uint32_t seed = 0;
  int parts = 1;                 // it gets one of so many shares of the samples
  int samples = 0;               // of all parts; 0: the file's
  std::optional<float> noise;    // 0: all pixels get all samples; absent: the file's
  double time_limit = 0.0;       // seconds, of all parts
  std::optional<int> bounces;    // absent: the file's
  std::optional<float> shutter;  // angle, degrees; absent: the file's
  bool transparent = false;      // also if the file is not
  bool statistics = false;       // with the pass of the number of samples
  int threads = 0;
};

class CyclesSession {
 public:
  // Opens a .blend. camera: one of the file, by name; "none"; empty: the scene's. Throws Error(kInput): there is no
  // Blender, it cannot open the file, or not within options.seconds.
  CyclesSession(const BlenderOptions& options, const std::string& file, const std::string& camera);
  CyclesSession(const CyclesSession&) = delete;
  CyclesSession& operator=(const CyclesSession&) = delete;
  ~CyclesSession();  // ends Blender

  const CyclesScene& scene() const { return scene_; }

  // The graphics card that renders; empty: the processor. Known after the first shot.
  std::string device();

  // The most memory that Cycles has used for a shot so far, as it reports it, megabytes.
  double peak_memory();

  // A file in the session's own folder, which is removed with it.
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

  // Replaces the file's world in all shots from now on by lat-long pictures with -Z of our world in the middle: the light
  // around the scene, and what only the camera sees behind it. An empty path leaves the file's.
  void surround(const std::string& light, const std::string& background) { light_ = light, background_ = background; }

  // Returns the place of a shot without rendering it. Throws as render() does.
  CyclesPose pose(const CyclesShot& shot);

  // Renders a shot into a file (ods/picture/cycles_passes.h). report: gets the fraction done, several times a second.
  // Throws Error(kInput): Blender fails or ends.
  void render(const CyclesShot& shot, const std::string& path, const std::function<void(double)>& report);

 private:
  CyclesPose order(const CyclesShot& shot, const std::string& path, const std::function<void(double)>& report);
  void take(const std::string& line);
  void wait(const std::function<bool()>& is_done, const std::function<void(double)>& report, float seconds);
  [[noreturn]] void fail();

  std::string file_;
  ods::PrivateFolder folder_, scripts_;
  CyclesScene scene_;
  std::string light_, background_;  // surround()
  int orders_ = 0;

  std::mutex mutex_;  // for what the reader changes
  std::condition_variable changed_;
  bool is_open_ = false, has_ended_ = false;
  std::string error_, device_, pose_;
  int rendered_ = 0;
  double share_ = 0.0, peak_ = 0.0;
  std::optional<ProgramResult> result_;

  std::unique_ptr<RunningProgram> blender_;
  std::thread reader_;
};
