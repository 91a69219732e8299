// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Latency of the studio: milliseconds from each of 60 changes to its first picture while a finer one is rendered, how
// many of them were late, and how long that finer one takes to stop. Ratios are to the maximum latency of the studio.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "bench/measure.h"
#include "bench/subjects.h"
#include "ods/studio/live_render.h"

namespace {

using namespace ods;
using namespace std::chrono_literals;

constexpr Subject kRoom{"room"};
constexpr double kFirstLight = 300.0, kCancel = 50.0;  // milliseconds
constexpr int kChanges = 60, kCancels = 7;

double milliseconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// The time from a change of the camera to the first picture that shows it.
double milliseconds_to_change(LiveRender& live, LiveSettings& settings) {
  settings.camera.yaw += 7.0f;
  return milliseconds_of([&] {
    const int revision = live.set(settings, {});
    for (int number = 0;;) {
      const std::shared_ptr<const LiveFrame> frame = live.next_frame(number, 10s);
      if (frame && frame->revision == revision) return;
      if (frame) number = frame->number;
    }
  });
}

constexpr auto kNeverRest = 60s;

// The studio's steps take from milliseconds to seconds; different pauses before the changes meet several of them.
void pause_before(int change) {
  std::this_thread::sleep_for(500ms + (change % 12) * 170ms);
}

double share_of(std::vector<double> times, double share) {
  std::ranges::sort(times);
  return times[std::min(static_cast<size_t>(share * static_cast<double>(times.size())), times.size() - 1)];
}

struct Changes {
  std::vector<double> wall, cpu;  // milliseconds of each
};

Changes first_lights(Scene& scene, LiveSettings settings) {
  LiveRender live(scene, 0, kNeverRest);
  milliseconds_to_change(live, settings);
  Changes changes;
  for (int i = 0; i < kChanges; i++) {
    pause_before(i);
    const Seconds took = seconds_of([&] { milliseconds_to_change(live, settings); });
    changes.wall.push_back(1e3 * took.wall);
    changes.cpu.push_back(1e3 * took.cpu);
  }
  return changes;
}

// The time until the thread has ended, including freeing all of its memory: an upper bound.
double cancel(Scene& scene, LiveSettings settings) {
  std::vector<double> times;
  for (int change = 0; change < kCancels; change++) {
    std::optional<LiveRender> live(std::in_place, scene, 0, kNeverRest);
    milliseconds_to_change(*live, settings);
    pause_before(change);
    times.push_back(milliseconds_of([&] { live.reset(); }));
  }
  return share_of(times, 0.5);
}

void change_to_first_light(benchmark::State& state, const Subject& subject) {
  Scene scene = load(subject);
  LiveSettings settings;
  settings.camera = camera_of(subject, scene);
  for (auto _ : state) {
    const Changes changes = first_lights(scene, settings);
    state.counters["first_light_ms"] = share_of(changes.wall, 0.5);
    state.counters["first_light_cpu_ms"] = share_of(changes.cpu, 0.5);
    state.counters["worst_ms"] = share_of(changes.wall, 1.0);
    state.counters["worst_cpu_ms"] = share_of(changes.cpu, 1.0);
    state.counters["late"] =
        static_cast<double>(std::ranges::count_if(changes.wall, [](double ms) { return ms > kFirstLight; }));
    state.counters["first_light_ratio"] = state.counters["first_light_ms"] / kFirstLight;
    state.counters["cancel_ms"] = cancel(scene, settings);
    state.counters["cancel_ratio"] = state.counters["cancel_ms"] / kCancel;
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
