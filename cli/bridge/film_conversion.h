// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A .blend whose animation takes Blender long to follow, such as a cloth: while one Blender converts the whole, another
// converts the first frames, which can be rendered meanwhile. They are the same as in the whole.
#pragma once
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cli/bridge/foreign_scene.h"
#include "ods/files/private_folder.h"

class FilmConversion {
 public:
  // Starts the conversion of a .blend, unless it is kept. beginning: what may be converted before.
  FilmConversion(const std::string& path, const BlenderOptions& options, const FilmBeginning& beginning);
  FilmConversion(const FilmConversion&) = delete;
  FilmConversion& operator=(const FilmConversion&) = delete;
  ~FilmConversion();  // ends Blender

  // Waits for the whole scene. If that is found to take long, returns its beginning as soon as there is one; its files
  // exist as long as this object. Returns nullopt if the whole is sooner, or if the beginning does not show what the
  // whole does: light and viewer must be the file's.
  std::optional<ForeignScene> beginning();

  // Waits for the whole scene. Throws as convert_foreign_scene() does.
  ForeignScene whole();

 private:
  std::string path_;
  BlenderOptions options_;
  FilmBeginning beginning_;
  std::unique_ptr<ods::PrivateFolder> folder_;  // of the beginning
  std::mutex mutex_;                            // for what the thread changes
  std::condition_variable changed_;
  bool is_slow_ = false, is_over_ = false;
  std::optional<ForeignScene> whole_;
  std::exception_ptr failure_;
  std::stop_source no_beginning_;  // once the whole is there
  std::jthread thread_;
};
