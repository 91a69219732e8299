// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/view_files.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/frames.h"
#include "ods/stitch/slit_file.h"

namespace ods {

namespace {

// The eye and the number in the name of a view's file.
struct Named {
  int eye = kMono;
  int number = 0;
};

Named named(const SlitRig& rig, const ViewFiles& files, size_t view) {
  const size_t of_eye = rig.views.size() / rig.eyes.size();
  const bool by_eye = names_eye(files.names);
  return {rig.eyes[view / of_eye], static_cast<int>(by_eye ? view % of_eye : view) + 1};
}

StoredPicture open_file(const std::string& path, const CameraRig& pose) {
  OpenOptions options;
  options.form.one_eye = true;
  options.form.camera = pose;
  return open_picture(path, options);
}

}  // namespace

std::string names_fault(const SlitRig& rig, const ViewFiles& files) {
  if (!frame_names(files.names)) {
    return fmt::format("'{}' has no place for the number of the view: views/####.exr", files.names);
  }
  if (names_eye(files.names) && rig.eyes.size() < 2) {
    return fmt::format("'{}' is for two eyes, and the rig has one", files.names);
  }
  return "";
}

std::string view_path(const SlitRig& rig, const ViewFiles& files, size_t view) {
  const Named name = named(rig, files, view);
  return path_for_eye(frame_names(files.names)->path(name.number), name.eye);
}

OpenView open_view_files(const SlitRig& rig, const ViewFiles& files) {
  return [&rig, files](size_t view) {
    const std::string path = view_path(rig, files, view);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw Error(ErrorKind::kInput, fmt::format("'{}' is not there", path));
    return open_file(path, rig.views[view]);
  };
}

std::vector<ViewFault> missing_views(const SlitRig& rig, const ViewFiles& files, bool thorough) {
  std::vector<std::string> found(rig.views.size());
  tbb::parallel_for(size_t{0}, rig.views.size(), [&](size_t i) {
    const std::string path = view_path(rig, files, i);
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error || size == 0) {
      found[i] = fmt::format("'{}' is {}", path, error ? "not there" : "empty");
      return;
    }
    if (!thorough) return;
    try {
      const Extent is = open_file(path, rig.views[i]).size, should = rig.view;
      if (is.width != should.width || is.height != should.height) {
        found[i] = fmt::format("'{}' is {}x{}, not {}x{}", path, is.width, is.height, should.width, should.height);
      }
    } catch (const Error& fault) {
      found[i] = fault.what();
    }
  });
  std::vector<ViewFault> faults;
  for (size_t i = 0; i < found.size(); i++) {
    if (!found[i].empty()) faults.push_back({i, found[i]});
  }
  return faults;
}

// FNV-1a. Source: Fowler, Noll, Vo; RFC 9923.
static void add_to_key(const void* data, size_t size, uint64_t& key) {
  const unsigned char* bytes = static_cast<const unsigned char*>(data);
  for (size_t i = 0; i < size; i++) key = (key ^ bytes[i]) * 0x100000001b3u;
}

uint64_t views_key(const SlitRig& rig, const ViewFiles& files) {
  uint64_t key = 0xcbf29ce484222325u;
  const std::string text = write_slit_rig(rig);
  add_to_key(text.data(), text.size(), key);
  for (size_t i = 0; i < rig.views.size(); i++) {
    const std::string path = view_path(rig, files, i);
    std::error_code ignored;
    const uint64_t size = std::filesystem::file_size(path, ignored);
    const auto time = std::filesystem::last_write_time(path, ignored).time_since_epoch().count();
    add_to_key(&size, sizeof size, key);
    add_to_key(&time, sizeof time, key);
  }
  return key;
}

std::string view_ranges(const SlitRig& rig, const ViewFiles& files, const std::vector<ViewFault>& faults) {
  std::string text;
  for (const int eye : rig.eyes) {
    std::vector<int> numbers;
    for (const ViewFault& fault : faults) {
      const Named name = named(rig, files, fault.view);
      if (name.eye == eye || !names_eye(files.names)) numbers.push_back(name.number);
    }
    if (!names_eye(files.names)) return frames_text(numbers);
    if (!numbers.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : " ", eye_name(eye), frames_text(numbers));
  }
  return text;
}

}  // namespace ods
