// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How soon the studio answers: milliseconds from a change to the first picture, while nothing is rendered and while a
// finer picture is. The difference is what it takes to cancel. Ratios are to the longest that the studio may take.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "bench/subjects.h"
#include "ods/studio/live_render.h"

namespace {

using namespace ods;
using namespace std::chrono_literals;

constexpr Subject kRoom{"room"};
constexpr double kFirstLight = 300.0, kCancel = 50.0;  // milliseconds
constexpr int kChanges = 7;

// From a change of the camera to the first picture that has it.
double milliseconds_to_change(LiveRender& live, LiveSettings& settings) {
  settings.camera.yaw += 7.0f;
  const auto start = std::chrono::steady_clock::now();
  const int revision = live.set(settings, {});
  for (int number = 0;;) {
    const std::shared_ptr<const LiveFrame> frame = live.next_frame(number, 10s);
    if (frame && frame->revision == revision) break;
    if (frame) number = frame->number;
  }
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// The median over changes that come some time after the picture before. rest_after: as LiveRender takes it.
double first_light(const Subject& subject, std::chrono::milliseconds rest_after, std::chrono::milliseconds pause) {
  Scene scene = load(subject);
  LiveSettings settings;
  settings.camera = camera_of(subject, scene);
  LiveRender live(scene, 0, rest_after);
  milliseconds_to_change(live, settings);
  std::vector<double> times;
  for (int i = 0; i < kChanges; i++) {
    std::this_thread::sleep_for(pause + i * pause / 3);  // not always at the same place of what is rendered
    times.push_back(milliseconds_to_change(live, settings));
  }
  std::nth_element(times.begin(), times.begin() + kChanges / 2, times.end());
  return times[kChanges / 2];
}

void change_to_first_light(benchmark::State& state, const Subject& subject) {
  for (auto _ : state) {
    const double rested = first_light(subject, 0ms, 4s);  // nobody waits, so it rests after the step under way
    const double busy = first_light(subject, 60s, 500ms);
    state.counters["first_light_ms"] = busy;
    state.counters["ratio"] = busy / kFirstLight;
    state.counters["cancel_ms"] = busy - rested;
    state.counters["cancel_ratio"] = (busy - rested) / kCancel;
  }
}

const bool registered = [] {
  for (const Subject& subject : {kAtrium, kRoom}) {
    benchmark::RegisterBenchmark((std::string("change_to_first_light/") + subject.name).c_str(),
                                 [subject](benchmark::State& state) { change_to_first_light(state, subject); })
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
  }
  return true;
}();

}  // namespace

BENCHMARK_MAIN();
