// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/compose/over_video.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "ods/base/error.h"
#include "ods/video/video_clock.h"
#include "ods/video/write_video.h"

namespace ods {

// --- the cover -------------------------------------------------------------------------------------------------------

Cover make_cover(const StoredPicture& foreground, const StoredPicture& video, const OverOptions& options) {
  const PictureRows rows = fitted_foreground(foreground, video, options);
  Cover cover;
  cover.eyes.resize(video.eyes.size());
  for (size_t eye = 0; eye < cover.eyes.size(); eye++) {
    cover.eyes[eye].resize(static_cast<size_t>(video.size.height));
    tbb::parallel_for(0, video.size.height, [&](int y) {
      std::vector<float> row(4 * static_cast<size_t>(video.size.width));
      rows.fill(static_cast<int>(eye), y, row);
      size_t first = 0, last = row.size() / 4;
      while (last > 0 && !(row[4 * last - 1] > 0.0f)) last--;
      while (first < last && !(row[4 * first + 3] > 0.0f)) first++;
      const auto at = [&](size_t x) { return row.begin() + static_cast<ptrdiff_t>(4 * x); };
      cover.eyes[eye][static_cast<size_t>(y)] = {static_cast<int>(first), {at(first), at(last)}};
    });
  }
  return cover;
}

// --- a frame ---------------------------------------------------------------------------------------------------------

static Planes planes_of(const Planes& all, const StoredPicture& video, size_t eye) {
  const EyeCorner corner = eye_corner(video.layout, video.size, static_cast<int>(eye));
  return all.at(corner.x, corner.y);
}

void copy_planes(const Planes& from, Extent size, const Planes& to) {
  const Extent block = chroma_block(from.chroma);
  const size_t sample = from.bits > 8 ? 2 : 1;
  for (size_t i = 0; i < 3; i++) {
    const Extent share = i == 0 ? Extent{1, 1} : block;
    const size_t row = static_cast<size_t>(size.width / share.width) * sample;
    tbb::parallel_for(tbb::blocked_range<int>(0, size.height / share.height, 64), [&](const auto& range) {
      for (int y = range.begin(); y < range.end(); y++) {
        const auto line = static_cast<size_t>(y);
        std::memcpy(to.first[i] + line * to.stride[i], from.first[i] + line * from.stride[i], row);
      }
    });
  }
}

std::shared_ptr<VideoFrame> copied_frame(const DecodedFrame& frame, const VideoStream& stream, const VideoInput& video,
                                         const Packing& packing) {
  auto result = std::make_shared<VideoFrame>(stream.size, packing);
  if (stream.color == ColorCode() && stream.bits == packing.bits && stream.chroma == packing.chroma) {
    copy_planes(frame.planes, stream.size, result->planes());
    return result;
  }
  for (size_t eye = 0; eye < video.prototype.eyes.size(); eye++) {
    const Planes from = planes_of(frame.planes, video.prototype, eye);
    const auto codes = [&](int y, std::span<float> row) {
      get_codes(from, video.prototype.size, stream.color, y, 0, row);
      for (float& code : row) code = std::clamp(code, 0.0f, 1.0f);
    };
    put_ycbcr(codes, video.prototype.size, planes_of(result->planes(), video.prototype, eye));
  }
  return result;
}

namespace {

// The rows of one eye that share chroma, while the cover is composited.
template <typename T>
class BlockRows {
 public:
  BlockRows(Extent size, const ColorCode& color, const Planes& from, const Planes& to)
      : size_(size), color_(color), from_(from), to_(to), block_(chroma_block(to.chroma)) {}

  void lay(const std::vector<AlphaRow>& cover, int block_row) {
    const int top = block_row * block_.height;
    first_ = size_.width, last_ = 0;
    for (int y = top; y < top + block_.height; y++) {
      const AlphaRow& row = cover[static_cast<size_t>(y)];
      if (row.rgba.empty()) continue;
      first_ = std::min(first_, row.first);
      last_ = std::max(last_, row.first + static_cast<int>(row.rgba.size() / 4));
    }
    if (first_ >= last_) return;
    const auto width = static_cast<size_t>(last_ - first_);
    for (auto& sum : sums_) sum.assign(width, 0.0f);
    for (int y = top; y < top + block_.height; y++) {
      if (!cover[static_cast<size_t>(y)].rgba.empty()) lay_row(cover[static_cast<size_t>(y)], y);
    }
    put_color(block_row);
  }

 private:
  void lay_row(const AlphaRow& cover, int y) {
    const size_t width = cover.rgba.size() / 4, before = static_cast<size_t>(cover.first - first_);
    back_.resize(3 * width);
    get_codes(from_, size_, color_, y, cover.first, back_);
    T* luma = reinterpret_cast<T*>(to_.first[0] + static_cast<size_t>(y) * to_.stride[0]) + cover.first;
    const float unit = static_cast<float>(1 << (to_.bits - 8)), share = 1.0f / static_cast<float>(block_.height);
    for (size_t x = 0; x < width; x++) {
      const float* front = &cover.rgba[4 * x];
      if (!(front[3] > 0.0f)) continue;
      std::array<float, 3> codes;
      for (size_t c = 0; c < 3; c++) {
        float light = front[c];
        if (front[3] < 1.0f) light += srgb_decode(std::clamp(back_[x + c * width], 0.0f, 1.0f)) * (1.0f - front[3]);
        codes[c] = video_code(std::clamp(light, 0.0f, 1.0f));
      }
      const float bright = 0.2126f * codes[0] + 0.7152f * codes[1] + 0.0722f * codes[2];
      luma[x] = static_cast<T>((16.0f + 219.0f * bright) * unit + 0.5f);
      sums_[0][before + x] += (128.0f + 224.0f * (codes[2] - bright) / 1.8556f) * unit * share;
      sums_[1][before + x] += (128.0f + 224.0f * (codes[0] - bright) / 1.5748f) * unit * share;
      sums_[2][before + x] += share;
    }
  }

  // Shared chroma is the mean over its pixels, as in put_ycbcr().
  void put_color(int block_row) {
    const auto at = [&](size_t which, int x) {
      return x < first_ || x >= last_ ? 0.0f : sums_[which][static_cast<size_t>(x - first_)];
    };
    for (int column = first_ / block_.width; column * block_.width <= last_ && column < size_.width / block_.width;
         column++) {
      const int x = column * block_.width;
      const auto mean = [&](size_t which) {
        if (block_.width == 1) return at(which, x);
        return 0.5f * at(which, x) + 0.25f * (at(which, std::max(x - 1, 0)) + at(which, x + 1));
      };
      const float covered = mean(2);
      if (!(covered > 0.0f)) continue;
      for (size_t i = 0; i < 2; i++) {
        T& color = reinterpret_cast<T*>(to_.first[i + 1] + static_cast<size_t>(block_row) * to_.stride[i + 1])[column];
        color = static_cast<T>(mean(i) + static_cast<float>(color) * (1.0f - covered) + 0.5f);
      }
    }
  }

  Extent size_;
  ColorCode color_;
  Planes from_, to_;
  Extent block_;
  int first_ = 0, last_ = 0;                // columns covered in any of the rows
  std::array<std::vector<float>, 3> sums_;  // per column: sums of Cb and Cr of the covered pixels, and their fraction
  std::vector<float> back_;
};

}  // namespace

template <typename T>
static void lay_eye(const std::vector<AlphaRow>& cover, Extent size, const ColorCode& color, const Planes& from,
                    const Planes& to) {
  const int rows = size.height / chroma_block(to.chroma).height;
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, 8), [&](const auto& range) {
    BlockRows<T> block(size, color, from, to);
    for (int row = range.begin(); row < range.end(); row++) block.lay(cover, row);
  });
}

void lay_cover(const Cover& cover, const StoredPicture& video, const ColorCode& color, const Planes& from,
               const Planes& to) {
  const auto lay = to.bits == 8 ? lay_eye<uint8_t> : lay_eye<uint16_t>;
  for (size_t eye = 0; eye < cover.eyes.size(); eye++) {
    lay(cover.eyes[eye], video.size, color, planes_of(from, video, eye), planes_of(to, video, eye));
  }
}

// --- the video -------------------------------------------------------------------------------------------------------

namespace {

class VideoOver {
 public:
  VideoOver(Footage& back, Footage& front, const OverOptions& over, const Packing& packing)
      : back_(back), front_(front), over_(over), packing_(packing) {
    if (front_.kind() == FootageKind::kPicture) still_ = cover_of(*front_.picture(0));
  }

  // A frame of the background, with the picture of a foreground that is a video: both are read by one thread at a time.
  std::function<std::shared_ptr<VideoFrame>()> pending(int number, const DecodedFrame& back) {
    std::optional<StoredPicture> front;
    if (front_.kind() == FootageKind::kVideo && !front_ended_) {
      front = front_.picture(number);
      front_ended_ = !front;
    }
    return [this, number, back, front] { return lay(number, back, front); };
  }

 private:
  std::shared_ptr<VideoFrame> lay(int number, const DecodedFrame& back, std::optional<StoredPicture> front) const {
    const std::shared_ptr<VideoFrame> frame = copied_frame(back, back_.stream(), back_.video(), packing_);
    if (front_.kind() == FootageKind::kFrames) front = front_.picture(number);
    if (front) {
      lay(cover_of(*front), back, *frame);
    } else if (still_) {
      lay(*still_, back, *frame);
    }
    return frame;
  }

  void lay(const Cover& cover, const DecodedFrame& back, const VideoFrame& frame) const {
    lay_cover(cover, back_.video().prototype, back_.stream().color, back.planes, frame.planes());
  }

  Cover cover_of(const StoredPicture& front) const {
    const StoredPicture& prototype = back_.video().prototype;
    const std::string fault = over_fault(front, prototype, over_);
    if (fault.empty()) return make_cover(front, prototype, over_);
    throw Error(ErrorKind::kUsage, fmt::format("'{}' over '{}': {}", front_.path(), back_.path(), fault));
  }

  Footage& back_;
  Footage& front_;
  OverOptions over_;
  Packing packing_;
  std::optional<Cover> still_;
  bool front_ended_ = false;
};

}  // namespace

int over_video(Footage& back, Footage& front, int first, int last, const OverOptions& over,
               const EncodeOptions& options, const std::string& path, const Progress& progress) {
  assert(back.kind() == FootageKind::kVideo && container_of_path(path) && first <= last);
  const VideoStream& stream = back.stream();
  refuse_other_colors(stream, back.path());
  VideoOver job(back, front, over, options.packing);
  int next = first;
  std::optional<DecodedFrame> decoded = back.decode(next);
  if (!decoded) {
    const ErrorKind kind = first > 0 ? ErrorKind::kUsage : ErrorKind::kInput;
    throw Error(kind, fmt::format("there is no picture {} in '{}'", first, back.path()));
  }
  NewVideo video;
  video.size = stream.size, video.options = options, video.metadata = back.video().metadata;
  const VideoClock clock(stream, decoded->time, options.keep.cut.is_cut);
  clock.set(video.options);
  const auto pending = [&]() -> std::optional<PendingFrame> {
    if (next > first && next <= last) decoded = back.decode(next);
    if (!decoded || next > last) return std::nullopt;
    return PendingFrame{clock(decoded->time), job.pending(next++, *decoded)};
  };
  // A foreground frame may take four floats per pixel, and its cover as many.
  const size_t pixels = static_cast<size_t>(stream.size.width) * static_cast<size_t>(stream.size.height);
  video.count = std::max(1, std::min(last, stream.count - 1) - first + 1);
  video.frame_bytes = pixels * (front.kind() == FootageKind::kPicture ? 6 : 6 + 32);
  return write_video(video, pending, path, progress).frames;
}

}  // namespace ods
