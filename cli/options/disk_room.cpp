// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/disk_room.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/files/atomic_file.h"
#include "ods/image/format/file_format.h"

namespace fs = std::filesystem;

namespace {

// Bytes per pixel of one eye.
double pixel_bytes(ods::FileFormat format, const ods::RenderOptions& options) {
  const int channels = options.transparent ? 4 : 3;
  switch (format) {
    case ods::FileFormat::kPng:
    case ods::FileFormat::kTiff:
      return channels;
    case ods::FileFormat::kJpeg:
    case ods::FileFormat::kWebp:
    case ods::FileFormat::kHeif:
      return 1.0;
    case ods::FileFormat::kHdr:
      return 4.0;
    case ods::FileFormat::kExr:
      return 2.0 * channels + (options.layers ? 4.0 + 6.0 + 6.0 : 0.0);  // 32-bit Z, normals, albedo
  }
  return 0.0;
}

}  // namespace

double largest_frame(const std::string& path, const ods::RenderOptions& options, const ods::SaveOptions& save) {
  const auto eyes = static_cast<int>(ods::eye_list(options.eyes).size());
  const ods::Extent eye = ods::squeezed_eye(save.layout, {options.width, options.height}, eyes);
  const ods::EyePacking how = ods::arrangement_of(save.layout).how;
  const int stored = how == ods::EyePacking::kMixed || how == ods::EyePacking::kCheckerboard ? 1 : eyes;
  return 1.0 * eye.width * eye.height * stored * pixel_bytes(*ods::format_of_path(path), options);
}

namespace {

struct DiskRoom {
  bool fits = true;
  std::string text;  // empty: no message
};

// how_much: "up to", "about".
DiskRoom room_for(const std::string& path, size_t frames, double bytes_of_frame, const char* how_much) {
  std::error_code error;
  const fs::space_info space = fs::space(ods::existing_folder_of(path), error);
  if (error || frames == 0) return {};
  const double needed = static_cast<double>(frames) * bytes_of_frame;
  const bool fits = needed <= static_cast<double>(space.available);
  if (fits && needed < 1e6) return {};
  const std::string shown = fs::path(path).parent_path().native();
  return {fits, fmt::format("the {} {} {} in '{}'; {} are free", frames == 1 ? "frame needs" : "frames need", how_much,
                            ods::bytes_text(static_cast<size_t>(needed)), shown.empty() ? "." : shown,
                            ods::bytes_text(static_cast<size_t>(space.available)))};
}

}  // namespace

void note_disk_space(const std::string& path, size_t frames, double bytes_of_frame) {
  const DiskRoom room = room_for(path, frames, bytes_of_frame, "up to");
  if (!room.text.empty()) room.fits ? note(room.text) : warn(room.text);
}

void check_disk_room(const std::string& path, size_t frames, double bytes_of_frame, bool anyway) {
  const DiskRoom room = room_for(path, frames, bytes_of_frame, "about");
  if (room.fits && !room.text.empty()) note(room.text);
  if (room.fits) return;
  if (!anyway) {
    throw ods::Error(ods::ErrorKind::kOutput,
                     room.text + ": make room, choose a smaller --width, or render them anyway with --force");
  }
  warn(room.text);
}
