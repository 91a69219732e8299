// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Plans the passes over all pixels in which a picture is rendered: the samples that each pass adds, and the progress.
#pragma once
#include "ods/render/render_options.h"

namespace ods {

class Passes {
 public:
  // done: samples from an earlier run.
  explicit Passes(const RenderOptions& options, int done);

  // The number of samples that the next pass adds to each pixel, after `seconds` of work; 0 if the picture is finished.
  // The first pass always takes place, whatever the time limit.
  int next_step(double seconds);

  // Continues a pass that an earlier run has begun.
  void resume_step(int step) { step_ = step; }
  int step() const { return step_; }

  // Reports the duration of the pass.
  void finish_step(double seconds);

  // Sets the number of samples that the picture may still need to be clean, as a multiple of its present samples; 0 if
  // it is clean.
  void expect(double more);

  // The progress, 0..1, when a part of the current pass is done, after `seconds` of work. Never decreases.
  double fraction(double part, double seconds);

  // Returns whether the noise can be judged: clean blocks stop from here on.
  bool can_judge() const;

  int done() const { return done_; }

  // Returns whether the time limit was reached before the picture was finished.
  bool ran_out_of_time() const { return late_; }

 private:
  RenderOptions options_;
  int end_;  // end of this part's samples
  int begun_with_;
  int done_;
  int step_ = 0;
  double expected_;  // expected total number of samples
  double seconds_per_sample_ = 0.0;
  double shown_ = 0.0;
  bool late_ = false;
};

// Number of samples after which noise is judged for the first time. Source: Cycles' rule.
int fewest_samples(const RenderOptions& options);

}  // namespace ods
