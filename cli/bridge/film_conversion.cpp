// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/film_conversion.h"

#include <utility>

#include "cli/bridge/scene_cache.h"
#include "ods/base/error.h"

FilmConversion::FilmConversion(const std::string& path, const BlenderOptions& options, const FilmBeginning& beginning)
    : path_(path), options_(options), beginning_(beginning), thread_([this](const std::stop_token& stop) {
        std::optional<ForeignScene> found;
        std::exception_ptr failure;
        const auto set_slow = [this] {
          const std::lock_guard lock(mutex_);
          is_slow_ = true;
          changed_.notify_all();
        };
        try {
          found = convert_foreign_scene(path_, options_, {set_slow, stop});
        } catch (...) {
          failure = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        whole_ = std::move(found), failure_ = failure, is_over_ = true;
        no_beginning_.request_stop();
        changed_.notify_all();
      }) {}

FilmConversion::~FilmConversion() {
  thread_.request_stop();
}

std::optional<ForeignScene> FilmConversion::beginning() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_slow_ || is_over_; });
    if (is_over_) return std::nullopt;
  }
  folder_ = std::make_unique<ods::PrivateFolder>(cache_folder() + "/.new-");
  try {
    run_blender(options_, path_, folder_->path(), {{}, no_beginning_.get_token()}, beginning_);
  } catch (const ods::Error&) {
    return std::nullopt;  // the whole is there, or will report why not
  }
  ForeignScene scene = read_bridge(folder_->path());
  scene.is_blender_file = true;
  if (!scene.camera || scene.environment.empty()) return std::nullopt;
  return scene;
}

ForeignScene FilmConversion::whole() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return is_over_; });
  if (failure_) std::rethrow_exception(failure_);
  return *whole_;
}
