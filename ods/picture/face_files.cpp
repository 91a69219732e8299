// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/face_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "ods/base/error.h"
#include "ods/files/read_file.h"

namespace ods {

namespace {

constexpr size_t kColumns = 3;

// The face in each cell of cube-3x2, as its index in FaceWords, and whether it is upside down there.
struct FaceCell {
  size_t face;
  bool is_turned;
};
constexpr FaceCell kCells[kFaceCount] = {{4, false}, {2, true}, {3, true}, {0, false}, {5, false}, {1, false}};

class FaceRows final : public RowReader {
 public:
  FaceRows(std::vector<std::unique_ptr<RowReader>> faces, FileInfo info)
      : faces_(std::move(faces)), info_(std::move(info)), side_(info_.height / 2), whole_(kFaceCount) {}

  const FileInfo& info() const override { return info_; }
  const ColorSpace& color_space() const override { return faces_[0]->color_space(); }
  void widen() override {
    for (const auto& face : faces_) face->widen();
    info_.samples = faces_[0]->info().samples;
  }
  bool is_whole_number(size_t channel) const override { return faces_[0]->is_whole_number(channel); }
  int band_rows() const override { return side_; }
  const std::map<size_t, unsigned>& beyond_floats() const override { return beyond_floats_; }

  void read(int begin, int end, size_t channels, std::byte* to) override {
    size_t pixel = 0;
    for (size_t c = 0; c < channels; c++) pixel += bytes_of(info_.samples[c]);
    for (int y = begin; y < end; y++) {
      for (size_t column = 0; column < kColumns; column++, to += pixel * side()) {
        read_row(kCells[static_cast<size_t>(y / side_) * kColumns + column], y % side_, channels, pixel, to);
      }
    }
  }

 private:
  size_t side() const { return static_cast<size_t>(side_); }

  // One row of a face. A face is decoded when its first row is needed, and forgotten with its last one.
  void read_row(const FaceCell& cell, int y, size_t channels, size_t pixel, std::byte* to) {
    std::vector<std::byte>& rows = whole_[cell.face];
    if (rows.empty()) decode(cell.face, channels, pixel);
    const std::byte* from = &rows[static_cast<size_t>(cell.is_turned ? side_ - 1 - y : y) * pixel * side()];
    if (!cell.is_turned) {
      std::memcpy(to, from, pixel * side());
    } else {
      for (size_t x = 0; x < side(); x++) std::memcpy(to + x * pixel, from + (side() - 1 - x) * pixel, pixel);
    }
    if (y == side_ - 1) std::vector<std::byte>().swap(rows);
  }

  void decode(size_t index, size_t channels, size_t pixel) {
    RowReader& face = *faces_[index];
    std::vector<std::byte>& rows = whole_[index];
    rows.resize(pixel * side() * side());
    for (int y = 0; y < side_; y += face.band_rows()) {
      face.read(y, std::min(y + face.band_rows(), side_), channels, &rows[static_cast<size_t>(y) * pixel * side()]);
    }
    beyond_floats_.insert(face.beyond_floats().begin(), face.beyond_floats().end());
  }

  std::vector<std::unique_ptr<RowReader>> faces_;
  FileInfo info_;
  int side_;
  std::vector<std::vector<std::byte>> whole_;  // by face; empty: not decoded
  std::map<size_t, unsigned> beyond_floats_;
};

void check_faces(const std::vector<std::unique_ptr<RowReader>>& faces, const std::string& path) {
  const FileInfo& first = faces[0]->info();
  for (const auto& face : faces) {
    const FileInfo& info = face->info();
    if (info.width != info.height || info.width != first.width) {
      throw cannot_read(path, fmt::format("faces of a cube are squares of one size, and two of these have {}x{} and "
                                          "{}x{} pixels",
                                          first.width, first.height, info.width, info.height));
    }
    const bool same_light = face->color_space().name == faces[0]->color_space().name || !info.is_float;
    if (info.is_float != first.is_float || info.channels.size() != first.channels.size() || !same_light) {
      throw cannot_read(path, "its faces differ in channels or colour space: convert them to one format first");
    }
  }
}

}  // namespace

std::unique_ptr<RowReader> open_faces(const std::string& path) {
  std::vector<std::unique_ptr<RowReader>> faces;
  for (const std::string& file : files_of(path)) faces.push_back(open_rows(file));
  check_faces(faces, path);
  const auto is_narrow = [](const auto& face) { return face->info().samples[0] == SampleType::kUint8; };
  if (!std::ranges::all_of(faces, is_narrow)) {
    for (const auto& face : faces) face->widen();
  }
  FileInfo info = faces[0]->info();
  info.width = 3 * info.width, info.height = 2 * info.height;
  info.text.clear(), info.numbers.clear();  // about one face
  info.is_pair = false;
  return std::make_unique<FaceRows>(std::move(faces), std::move(info));
}

}  // namespace ods
