// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture is rendered in passes over all its pixels. How many samples each pass adds, and how far the picture is.
#pragma once
#include "ods/render/render_options.h"

namespace ods {

class Passes {
 public:
  // done: samples that an earlier run has taken.
  explicit Passes(const RenderOptions& options, int done = 0);

  // The samples that the next pass adds to each pixel, after `seconds` of work; 0: the picture is finished. The first
  // pass always takes place, whatever the time limit.
  int next_step(double seconds);

  // The pass took this long.
  void finish_step(double seconds);

  // How many more samples the picture may need to be clean, as a multiple of those it has; 0: it is clean.
  void expect(double more);

  // How far the picture is when a part of the current pass is done, 0..1, after `seconds` of work. Never falls.
  double fraction(double part, double seconds);

  // Whether the noise can be judged: clean blocks stop from here on.
  bool can_judge() const;

  int done() const { return done_; }

  // Whether time ran out before the picture was finished.
  bool ran_out_of_time() const { return late_; }

 private:
  RenderOptions options_;
  int begun_with_;
  int done_;
  int step_ = 0;
  double expected_;  // samples in all, as far as is known
  double seconds_per_sample_ = 0.0;
  double shown_ = 0.0;
  bool late_ = false;
};

// The samples after which noise is judged for the first time. Source: Cycles' rule.
int fewest_samples(const RenderOptions& options);

}  // namespace ods
