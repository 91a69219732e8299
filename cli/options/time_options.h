// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of time: a moment of a scene, or the frames of a video and the camera's move in it.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/options.h"
#include "cli/options/camera_options.h"
#include "ods/base/names.h"
#include "ods/camera/camera_move.h"
#include "ods/scene/scene.h"

// The noise of a video's frames: the same for all, or its own for each.
enum class Grain { kFixed, kChanging };
inline constexpr ods::NameRow<Grain> kGrainTable[] = {
    {Grain::kFixed, "fixed"},
    {Grain::kChanging, "changing"},
};
static_assert(ods::has_every_member(kGrainTable));
inline constexpr auto kGrains = ods::members_of(kGrainTable);
constexpr std::string_view grain_name(Grain noise) {
  return ods::name_in(kGrainTable, noise);
}

struct TimeOptions {
  FileFrames file;                 // the frames of the scene's file; frame `first` is at 0 seconds
  std::optional<float> time;       // seconds
  std::string animation;           // empty: ods::play() chooses
  std::string frames;              // empty or "all": the whole duration
  std::string only;                // the frames that this process makes, or its share, "3/8"; empty: all
  std::optional<float> given_fps;  // --fps
  float fps = 30.0f;               // that, or the converted scene's, or this
  std::optional<float> duration;   // seconds; of a video, or of the camera's move
  ods::CameraMove move;
  std::optional<float> given_shutter;  // --shutter
  float shutter = 0.0f;  // that, or the converted scene's: shutter angle, degrees; 360 is the time between two frames
  std::optional<Grain> grain;  // empty: start_clock() chooses
  bool skip_existing = false;
  bool is_video = false;  // the command makes a video, independent of other options
};

// Adds --animation alone, for commands with options of time of their own.
void add_animation_option(Options& options, TimeOptions& time);

// Adds all options of time, --animation among them.
void add_time_options(Options& options, TimeOptions& time);

// Returns whether the options specify a video, frame by frame.
bool makes_video(const TimeOptions& time);

// Checks the options as a whole. Throws UsageError and ods::Error.
void check_time_options(const TimeOptions& time);

// Starts the requested animations, finds the length of the video, and sets time.grain: by default kChanging if the
// options or the file move the camera. Where --turntable turns an object instead of the camera, the object's turning
// becomes a part of the scene's animation, and time.move no longer has it. Throws UsageError.
void start_clock(TimeOptions& time, const CameraOptions& camera, ods::Scene& scene);

// Checks the value of --only. Throws UsageError and ods::Error(kUsage).
void check_only(const std::string& only);

// Returns the frames of `all` that --only names, by their numbers (a farm may name some beyond the end) or as one of N
// consecutive shares. Returns all without --only. Throws UsageError if a list does not name any of them.
std::vector<int> own_frames(const std::string& only, const std::vector<int>& all);

// The frames of the video; frame f is at (f - file.first) / fps seconds. Precondition: start_clock() has run. Throws
// UsageError if the file does not have any of the frames that the options name, and ods::Error.
std::vector<int> video_frames(const TimeOptions& time);
