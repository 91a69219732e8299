// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that say when: a moment of a scene, or the frames of a film and how the camera moves in it.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/console/options.h"
#include "ods/camera/camera_move.h"
#include "ods/scene/scene.h"

// Whether every frame of a film has the same noise, or each its own.
enum class FilmNoise { kFixed, kChanging };
inline constexpr FilmNoise kFilmNoises[] = {FilmNoise::kFixed, FilmNoise::kChanging};
std::string_view film_noise_name(FilmNoise noise);  // fixed, changing

struct TimeOptions {
  std::optional<float> time;  // seconds
  std::string animation;      // empty: what ods::play() chooses
  std::string frames;         // empty or "all": all of the duration
  float fps = 30.0f;
  std::optional<float> duration;  // seconds; of a film, or of the camera's move
  ods::CameraMove move;
  float shutter = 0.0f;  // degrees of the time between two frames
  FilmNoise noise = FilmNoise::kFixed;
  bool skip_existing = false;
  bool is_film = false;  // whatever else is given
};

void add_time_options(Options& options, TimeOptions& time);

// Whether a film is asked for, frame by frame.
bool asks_for_film(const TimeOptions& time);

// Looks at what was given as a whole. Throws UsageError and ods::Error.
void check_time_options(const TimeOptions& time);

// Lets the scene play what was asked for, and finds out how long the film is. Throws UsageError.
void start_clock(TimeOptions& time, ods::Scene& scene);

// The frames of the film; frame f is at f / fps seconds. Precondition: start_clock() has run. Throws ods::Error.
std::vector<int> film_frames(const TimeOptions& time);
