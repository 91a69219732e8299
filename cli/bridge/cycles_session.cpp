// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/cycles_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/files/atomic_file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::string_view kOfBridge = "ods-bridge ";
constexpr auto kBetweenReports = std::chrono::milliseconds(100);

json read_json(const std::string& path) {
  std::ifstream file(path);
  return json::parse(file, nullptr, false);
}

CyclesScene read_scene(const std::string& folder) {
  const json found = read_json(folder + "/bridge.json");
  CyclesScene scene;
  scene.foreign = read_bridge(folder);
  scene.foreign.file.clear();
  scene.foreign.is_blender_file = true;
  if (!found.is_object()) return scene;
  scene.blender = found.value("blender", "");
  scene.now = found.value("now", 0.0);
  scene.fps = found.value("fps", 24.0);
  scene.samples = found.value("samples", 0);
  scene.exposure = found.value("exposure", 0.0f);
  scene.view = found.value("view", "");
  scene.transparent = found.value("transparent", false);
  scene.camera = found.value("camera_name", "");
  return scene;
}

template <class Value>
json value_or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json();
}

nlohmann::ordered_json place_of(const CyclesPose& pose) {
  return {{"position", {pose.position.x, pose.position.y, pose.position.z}}, {"yaw", pose.yaw}};
}

nlohmann::ordered_json order_of(const CyclesShot& shot, const std::string& path) {
  const ods::StereoCamera& camera = shot.camera;
  const ods::ProjectionSetting& range = camera.projection;
  nlohmann::ordered_json order = {
      {"frame", shot.frame},
      {"eye", shot.eye},
      {"size", {shot.size.width, shot.size.height}},
      {"path", path},
      {"yaw", value_or_null(shot.yaw)},
      {"pitch", camera.pitch},
      {"roll", camera.roll},
      {"range", {range.longitude.x, range.longitude.y, range.latitude.x, range.latitude.y}},
      {"ipd", camera.ipd},
      {"toe_in", camera.convergence == ods::kToeIn},
      {"convergence_distance", camera.convergence_distance},
      {"lens_radius", camera.lens_radius},
      {"focus_distance", camera.focus_distance},
      {"device", shot.device},
      {"seed", shot.seed},
      {"parts", shot.parts},
      {"samples", shot.samples},
      {"noise", value_or_null(shot.noise)},
      {"time_limit", shot.time_limit},
      {"bounces", value_or_null(shot.bounces)},
      {"shutter", value_or_null(shot.shutter)},
      {"transparent", shot.transparent},
      {"statistics", shot.statistics},
      {"threads", shot.threads},
      {"position", nullptr},
      {"around", nullptr},
      {"merge", nullptr},
      {"light", nullptr},
      {"background", nullptr},
  };
  if (shot.position) order["position"] = {shot.position->x, shot.position->y, shot.position->z};
  if (shot.before && shot.after) order["around"] = {place_of(*shot.before), place_of(*shot.after)};
  if (camera.top.mode != ods::kMergeNone) order["merge"] = {camera.top.start, camera.top.end};
  return order;
}

// Returns the number before and after a slash that follow a word in a line of Cycles' progress: "Sample 3/16".
std::optional<std::pair<double, double>> ratio_after(const std::string& line, const char* word) {
  const size_t at = line.rfind(word);
  double done = 0.0, all = 0.0;
  if (at == std::string::npos ||
      std::sscanf(line.c_str() + at + std::char_traits<char>::length(word), "%lf/%lf", &done, &all) != 2) {
    return {};
  }
  return all > 0.0 ? std::optional(std::pair(done, all)) : std::nullopt;
}

// Returns the megabytes in a line of Cycles' progress: "| Mem:1.20M, Peak:3.45M |".
double peak_in(const std::string& line) {
  const size_t at = line.rfind("Peak:");
  double peak = 0.0;
  if (at == std::string::npos || std::sscanf(line.c_str() + at, "Peak:%lfM", &peak) != 1) return 0.0;
  return peak;
}

}  // namespace

CyclesSession::CyclesSession(const BlenderOptions& options, const std::string& file, const std::string& camera)
    : file_(file) {
  std::vector<std::string> arguments = {"render", fs::absolute(file).native(), folder_.path()};
  if (!options.scene.empty()) arguments.insert(arguments.end(), {"--scene", options.scene});
  if (!camera.empty()) arguments.insert(arguments.end(), {"--camera", camera});
  Program program = blender_program(options, {"--factory-startup"}, scripts_.path(), "run.py", arguments);
  program.limit.reset();  // of the opening alone
  program.folder = folder_.path();
  program.take_error = [this](const std::string& line) { take(line); };
  blender_ = std::make_unique<RunningProgram>(program);
  reader_ = std::thread([this] {
    ProgramResult result = blender_->finish();
    const std::lock_guard lock(mutex_);
    result_ = std::move(result), has_ended_ = true;
    changed_.notify_all();
  });
  try {
    wait([this] { return is_open_; }, {}, options.seconds);
    scene_ = read_scene(folder_.path());
  } catch (...) {
    blender_->end();
    reader_.join();
    throw;
  }
}

CyclesSession::~CyclesSession() {
  blender_->end();
  if (reader_.joinable()) reader_.join();
}

void CyclesSession::take(const std::string& line) {
  const std::lock_guard lock(mutex_);
  const auto is = [&](const char* word) { return line.substr(kOfBridge.size()).starts_with(word); };
  if (!line.starts_with(kOfBridge)) {
    peak_ = std::max(peak_, peak_in(line));
    const auto samples = ratio_after(line, "Sample ");
    if (!samples) return;
    const auto tiles = ratio_after(line, "Rendered ");
    const double part = samples->first / samples->second;
    share_ = tiles ? std::min(1.0, (tiles->first + part) / tiles->second) : part;
    return;
  }
  const std::string rest = line.substr(std::min(line.size(), line.find(' ', kOfBridge.size()) + 1));
  if (is("open ")) is_open_ = true;
  if (is("device ")) device_ = ods::one_line(rest);
  if (is("error ") && error_.empty()) error_ = ods::one_line(rest.substr(0, 400));
  if (is("rendered ")) rendered_++, pose_ = rest;
  changed_.notify_all();
}

void CyclesSession::fail() {
  std::string why = error_;
  if (why.empty() && result_ && result_->code == 127) why = "Blender cannot be started";
  if (why.empty() && result_ && result_->code > 128) {
    why = fmt::format("Blender crashed (signal {}); --blender PATH tries another", result_->code - 128);
  }
  if (why.empty()) why = "Blender ended before it was done";
  if (error_.empty() && result_ && !result_->last_line.empty()) why += "; its output: " + result_->last_line;
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}': {}", file_, why));
}

// seconds: the limit; 0: none.
void CyclesSession::wait(const std::function<bool()>& is_done, const std::function<void(double)>& report,
                         float seconds) {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!is_done()) {
    if (has_ended_ || !error_.empty()) fail();
    changed_.wait_for(lock, kBetweenReports);
    const double share = share_;
    lock.unlock();
    if (report) report(share);
    const std::chrono::duration<float> taken = std::chrono::steady_clock::now() - start;
    if (seconds > 0.0f && taken.count() > seconds) fail_in_time("Blender", file_, seconds);
    lock.lock();
  }
}

std::string CyclesSession::device() {
  const std::lock_guard lock(mutex_);
  return device_;
}

double CyclesSession::peak_memory() {
  const std::lock_guard lock(mutex_);
  return peak_;
}

// path: an empty one renders nothing.
CyclesPose CyclesSession::order(const CyclesShot& shot, const std::string& path,
                                const std::function<void(double)>& report) {
  const int number = ++orders_;
  {
    const std::lock_guard lock(mutex_);
    share_ = 0.0;
  }
  nlohmann::ordered_json wanted = order_of(shot, path);
  if (!light_.empty()) wanted["light"] = light_;
  if (!background_.empty()) wanted["background"] = background_;
  ods::write_file(fmt::format("{}/order.{}.json", folder_.path(), number), ods::json_document(wanted));
  wait([&] { return rendered_ >= number; }, report, 0.0f);
  const json pose = json::parse(pose_, nullptr, false);
  if (!pose.is_object())
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}': Blender's answer is damaged", file_));
  const json& at = pose["position"];
  return {{at[0].get<float>(), at[1].get<float>(), at[2].get<float>()}, pose["yaw"].get<float>()};
}

CyclesPose CyclesSession::pose(const CyclesShot& shot) {
  return order(shot, "", {});
}

void CyclesSession::render(const CyclesShot& shot, const std::string& path, const std::function<void(double)>& report) {
  ods::AtomicFile file(path);
  order(shot, fs::absolute(file.temporary()).native(), report);
  std::error_code error;
  if (fs::file_size(file.temporary(), error) == 0 || error) {
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}': Cycles has not written its picture", file_));
  }
  file.commit();
}
