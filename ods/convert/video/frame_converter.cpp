// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/video/frame_converter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "ods/convert/converter.h"
#include "ods/convert/correct.h"
#include "ods/convert/video/shifted_frame.h"

namespace ods {

// --- the old picture -------------------------------------------------------------------------------------------------

namespace {

// A decoded frame's pixels: linear light, or the code values of HDR.
class FrameTexels final : public TexelReader {
 public:
  FrameTexels(const StoredPicture& format, const VideoStream& stream, const DecodedFrame& frame)
      : size_(format.size), color_(stream.color), is_hdr_(stream.words.is_hdr()) {
    for (size_t i = 0; i < format.eyes.size(); i++) {
      const EyeCorner corner = eye_corner(format.layout, size_, static_cast<int>(i));
      eyes_.push_back(frame.planes.at(corner.x, corner.y));
    }
  }

  void read(int source_eye, const Cell& box, float* out) const override {
    const size_t width = static_cast<size_t>(box.right - box.left);
    thread_local std::vector<float> row;
    row.resize(3 * width);
    for (int y = box.top; y < box.bottom; y++, out += 4 * width) {
      get_codes(eyes_[static_cast<size_t>(source_eye)], size_, color_, y, box.left, row);
      if (!is_hdr_) {
        video_lights(row, out);
        continue;
      }
      for (size_t x = 0; x < 4 * width; x++) out[x] = x % 4 == 3 ? 0.0f : row[x % 4 * width + x / 4];
    }
  }

 private:
  Extent size_;
  ColorCode color_;
  bool is_hdr_;
  std::vector<Planes> eyes_;
};

}  // namespace

// --- the new frame ---------------------------------------------------------------------------------------------------

// `code` turns a pixel's light into its code values.
template <typename CodeOf>
static std::shared_ptr<VideoFrame> fill_frame(const PictureRows& rows, const FrameFormat& format, const CodeOf& code) {
  const int eyes = static_cast<int>(rows.eyes.size());
  auto frame = std::make_shared<VideoFrame>(packed_size(format.layout, rows.eye, eyes), format.packing);
  const size_t channels = count_channels(rows.layers), width = static_cast<size_t>(rows.eye.width);
  for (int i = 0; i < eyes; i++) {
    const EyeCorner corner = eyes == 1 ? EyeCorner() : eye_corner(format.layout, rows.eye, i);
    const auto codes = [&](int y, std::span<float> out) {
      thread_local std::vector<float> row;
      row.resize(channels * width);
      rows.fill(i, y, row);
      for (size_t x = 0; x < width; x++) {
        const float* pixel = &row[x * channels];
        const vec3 value = code(vec3(pixel[0], pixel[1], pixel[2]));
        out[x] = value.x, out[x + width] = value.y, out[x + 2 * width] = value.z;
      }
    };
    put_ycbcr(codes, rows.eye, frame->planes().at(corner.x, corner.y), format.color);
  }
  return frame;
}

static vec3 encoded(vec3 light) {
  return {video_code(light.x), video_code(light.y), video_code(light.z)};
}

std::shared_ptr<VideoFrame> frame_of(const PictureRows& rows, const FrameFormat& format,
                                     const std::optional<DisplayTransform>& display) {
  if (!display) return fill_frame(rows, format, encoded);
  return fill_frame(rows, format,
                    [&](vec3 light) { return encoded(tone_map(light, display->exposure, display->tone)); });
}

// --- the converter ---------------------------------------------------------------------------------------------------

struct FrameConverter::State {
  const VideoInput& video;
  const VideoStream& stream;
  ConvertTarget target;
  FrameFormat format;
  std::optional<SourcePlan> plan;                 // the same for all frames; not set if each frame has its own rotation
  std::optional<std::vector<PixelShift>> shifts;  // set if pixels of frames are copied
  FramePool frames;

  std::shared_ptr<VideoFrame> copy(const DecodedFrame& frame) const;
};

static Extent size_of(const ConvertTarget& target, const FrameFormat& format) {
  return packed_size(format.layout, target.eye, static_cast<int>(target.eyes.size()));
}

FrameConverter::FrameConverter(const VideoInput& video, const VideoStream& stream, const ConvertTarget& target,
                               const FrameFormat& format, bool has_turns)
    : state_(new State{video, stream, target, format, {}, {}, {size_of(target, format), format.packing}}) {
  if (has_turns) return;
  state_->plan = make_plan(video.prototype, target);
  const bool same_numbers = format.packing.bits == stream.bits && format.packing.chroma == stream.chroma &&
                            format.color == stream.color && !changes_colors(target.right);
  if (same_numbers) state_->shifts = find_shifts(state_->plan->mapping, chroma_block(stream.chroma));
  if (!state_->shifts) remember_rows(*state_->plan);
}

static Planes planes_of(const Planes& planes, Layout layout, Extent eye, size_t eyes, int index) {
  const EyeCorner corner = eyes == 1 ? EyeCorner() : eye_corner(layout, eye, index);
  return planes.at(corner.x, corner.y);
}

std::shared_ptr<VideoFrame> FrameConverter::State::copy(const DecodedFrame& frame) const {
  const StoredPicture& old = video.prototype;
  const Extent size = target.eye;
  const int eyes = static_cast<int>(target.eyes.size());
  std::shared_ptr<VideoFrame> result = frames.take();
  for (int i = 0; i < eyes; i++) {
    const PixelShift& shift = (*shifts)[static_cast<size_t>(i)];
    copy_shifted(planes_of(frame.planes, old.layout, old.size, old.eyes.size(), shift.source_eye), old.size, shift,
                 planes_of(result->planes(), format.layout, size, target.eyes.size(), i), size);
  }
  return result;
}

FrameConverter::~FrameConverter() = default;

std::shared_ptr<VideoFrame> FrameConverter::convert(const DecodedFrame& frame, const ViewAngles& turned) const {
  const State& state = *state_;
  if (state.shifts) return state.copy(frame);
  std::optional<SourcePlan> own;
  if (!state.plan) {
    ConvertTarget target = state.target;
    target.turned = turned;
    own = make_plan(state.video.prototype, target);
    remember_rows(*own);
  }
  const FrameTexels texels(state.video.prototype, state.stream, frame);
  const Converter converter(state.plan ? *state.plan : *own, texels);
  const Extent eye = state.target.eye;
  const int eyes = static_cast<int>(state.target.eyes.size());
  const size_t width = static_cast<size_t>(eye.width);
  std::shared_ptr<VideoFrame> result = state.frames.take();
  for (int i = 0; i < eyes; i++) {
    const auto codes = [&](int y, int count, std::span<float> out) {
      thread_local std::vector<float> pixels;
      pixels.resize(out.size());
      converter.fill_band(i, y, count, pixels);
      if (corrects_colors(state.video.prototype, state.target, i)) correct_colors(state.target.right, 3, pixels);
      for (size_t row = 0; row < static_cast<size_t>(count); row++) {
        float* pixel = &pixels[3 * width * row];
        if (!state.stream.words.is_hdr()) video_codes({pixel, 3 * width}, pixel);
        float* to = &out[3 * width * row];
        for (size_t x = 0; x < width; x++, pixel += 3)
          to[x] = pixel[0], to[x + width] = pixel[1], to[x + 2 * width] = pixel[2];
      }
    };
    put_ycbcr_bands(codes, eye, planes_of(result->planes(), state.format.layout, eye, state.target.eyes.size(), i),
                    state.format.color);
  }
  return result;
}

}  // namespace ods
