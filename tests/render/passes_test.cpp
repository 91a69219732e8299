// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/passes.h"

#include <gtest/gtest.h>

#include <vector>

namespace ods {
namespace {

// The steps until the end, if a sample takes this many seconds and noise never falls.
std::vector<int> steps_of(const RenderOptions& options, double seconds_per_sample, double* seconds = nullptr) {
  Passes passes(options, 0);
  std::vector<int> steps;
  double now = 0.0;
  while (const int step = passes.next_step(now)) {
    steps.push_back(step);
    now += step * seconds_per_sample;
    passes.finish_step(step * seconds_per_sample);
    if (passes.can_judge()) passes.expect(1e6);
  }
  if (seconds) *seconds = now;
  return steps;
}

RenderOptions options_with(int samples, float noise, double time_limit) {
  RenderOptions options;
  options.samples = samples;
  options.noise = noise;
  options.time_limit = time_limit;
  return options;
}

TEST(Passes, DoubleTheSamples) {
  EXPECT_EQ(steps_of(options_with(100, 0.0f, 0.0), 1.0), (std::vector<int>{16, 16, 32, 36}));
  EXPECT_EQ(steps_of(options_with(10, 0.0f, 0.0), 1.0), std::vector<int>{10});
}

TEST(Passes, GrowWhileItIsNoisy) {
  // ceil(16 / 0.01^0.3) = 64, then a quarter more each time.
  EXPECT_EQ(steps_of(options_with(150, 0.01f, 0.0), 1.0), (std::vector<int>{16, 16, 32, 16, 32, 32, 6}));
}

TEST(Passes, EndWhenItIsClean) {
  const RenderOptions options = options_with(1000, 0.01f, 0.0);
  Passes passes(options, 0);
  for (const int step : {16, 16, 32}) {
    EXPECT_FALSE(passes.can_judge());
    EXPECT_EQ(passes.next_step(0.0), step);
    passes.finish_step(1.0);
  }
  EXPECT_TRUE(passes.can_judge());
  passes.expect(0.0);
  EXPECT_EQ(passes.next_step(1.0), 0);
  EXPECT_FALSE(passes.ran_out_of_time());
}

TEST(Passes, TimeLimitIsKept) {
  for (const double seconds_per_sample : {0.001, 0.1, 3.0, 70.0}) {
    double seconds = 0.0;
    const std::vector<int> steps = steps_of(options_with(1 << 20, 0.0f, 60.0), seconds_per_sample, &seconds);
    EXPECT_EQ(steps.front(), 1);
    EXPECT_LE(seconds, std::max(60.0, seconds_per_sample));
    EXPECT_GE(seconds, std::min(50.0, seconds_per_sample)) << seconds_per_sample;
    EXPECT_LT(steps.size(), 40u);
  }
}

TEST(Passes, FractionNeverFallsAndEndsAtOne) {
  const RenderOptions options = options_with(400, 0.02f, 0.0);
  Passes passes(options, 0);
  double last = 0.0;
  for (double more : {8.0, 12.0, 0.5, 0.0}) {
    const int step = passes.next_step(0.0);
    ASSERT_GT(step, 0);
    for (double part : {0.0, 0.5, 1.0}) {
      EXPECT_GE(passes.fraction(part, 0.0), last);
      last = passes.fraction(part, 0.0);
    }
    passes.finish_step(1.0);
    passes.expect(more);
  }
  EXPECT_EQ(passes.next_step(0.0), 0);
  EXPECT_NEAR(passes.fraction(0.0, 0.0), 1.0, 1e-9);
}

TEST(Passes, GoOnWhereAnEarlierRunStopped) {
  const RenderOptions options = options_with(100, 0.0f, 0.0);
  Passes passes(options, 40);
  EXPECT_EQ(passes.next_step(0.0), 48);
}

}  // namespace
}  // namespace ods
