// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods layers --frames: what moves, beside the layers that do not.
#pragma once
#include <optional>
#include <vector>

#include "cli/layers/layers_job.h"
#include "ods/layers/film/film_geometry.h"
#include "ods/layers/film/film_light.h"
#include "ods/layers/film/still_light.h"
#include "ods/sequence/frame_renderer.h"

struct FilmJob {
  std::vector<ods::SequenceFrame> frames;
  std::vector<ods::Mover> movers;
  ods::FilmGeometry geometry;
  std::vector<size_t> lights;  // the frames at which light is traced, by their index
  ods::CoarseLayers still;     // of the layers that do not move,
  ods::Image without;          // and their light without what moves
};

// The frames that the options name, or the one moment. time: the result of start_clock(). Throws UsageError if they are
// no film: fewer than two, too many, or backwards.
std::vector<ods::SequenceFrame> layer_frames(const LayersJob& job, const TimeOptions& time);

// Finds what moves and makes its geometry, and prints what it will cost. Throws UsageError if nothing moves, or if its
// light needs too much memory on graphics cards.
FilmJob plan_film(const LayersJob& job, ods::Scene& scene, std::vector<ods::SequenceFrame> frames,
                  const ods::HeadBox& box, int width);
