// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/compose/testcard_video.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "ods/compose/over_video.h"
#include "ods/video/write_video.h"

namespace ods {

// --- drawing ---------------------------------------------------------------------------------------------------------

static Testcard with_marks(const TestcardVideo& video, int number) {
  Testcard card = video.card;
  for (Card& mark : testcard_marks(video.camera, card.eye, number, video.rate.value()))
    card.cards.push_back(std::move(mark));
  return card;
}

static ColumnRuns runs_of(const Testcard& card, const std::vector<Card>& marks, int eye, int y) {
  const float pixel = 2.0f * kPi / static_cast<float>(std::max(8, std::min(card.eye.width, card.eye.height)));
  ColumnRuns runs;
  for (int x = 0; x < card.eye.width; x++) {
    const vec2 uv = (vec2(x, y) + 0.5f) / vec2(card.eye.width, card.eye.height);
    const vec3 direction = camera_ray(card.camera, eye, uv).direction;
    const auto meets = [&](const Card& mark) { return is_on_card(mark, direction, pixel); };
    if (direction == vec3(0.0f) || std::none_of(marks.begin(), marks.end(), meets)) continue;
    if (runs.empty() || runs.back()[1] < x) runs.push_back({x, x});
    runs.back()[1] = x + 1;
  }
  return runs;
}

static void draw_still(const TestcardVideo& video) {
  const Extent eye = video.card.eye;
  for (size_t i = 0; i < video.prototype.eyes.size(); i++) {
    const EyeCorner corner = eye_corner(video.prototype.layout, eye, static_cast<int>(i));
    const auto rows = [&](int y, std::span<float> row) {
      std::vector<float> pixels(row.size());
      fill_testcard_row(video.card, video.prototype.eyes[i].eye, y, pixels);
      const size_t width = row.size() / 3;
      for (size_t k = 0; k < row.size(); k++)
        row[k % 3 * width + k / 3] = video_code(std::clamp(pixels[k], 0.0f, 1.0f));
    };
    put_ycbcr(rows, eye, video.still->planes().at(corner.x, corner.y));
  }
}

TestcardVideo make_testcard_video(const Testcard& card, const StereoCamera& stereo, const std::vector<int>& eyes,
                                  const VideoPlan& plan, FrameRate rate, const Packing& packing) {
  TestcardVideo video;
  video.card = card;
  video.camera = stereo;
  video.rate = rate;
  video.packing = packing;
  video.prototype.size = card.eye;
  video.prototype.layout = plan.eyes == 2 ? plan.layout : Layout::kSeparate;
  for (const int eye : eyes) video.prototype.eyes.push_back({eye, {}});
  video.still = std::make_shared<VideoFrame>(plan.size, packing);
  draw_still(video);
  const std::vector<Card> marks = testcard_marks(stereo, card.eye, 0, rate.value());
  video.runs.resize(plan.eyes);
  for (size_t i = 0; i < plan.eyes; i++) {
    video.runs[i].resize(static_cast<size_t>(card.eye.height));
    tbb::parallel_for(0, card.eye.height, [&](int y) {
      video.runs[i][static_cast<size_t>(y)] = runs_of(card, marks, video.prototype.eyes[i].eye, y);
    });
  }
  return video;
}

std::shared_ptr<VideoFrame> testcard_frame(const TestcardVideo& video, int number) {
  const Testcard card = with_marks(video, number);
  Cover cover;
  cover.eyes.resize(video.runs.size());
  for (size_t i = 0; i < cover.eyes.size(); i++) {
    cover.eyes[i].resize(video.runs[i].size());
    tbb::parallel_for(0, card.eye.height, [&](int y) {
      const ColumnRuns& runs = video.runs[i][static_cast<size_t>(y)];
      if (runs.empty()) return;
      AlphaRow& row = cover.eyes[i][static_cast<size_t>(y)];
      row.first = runs.front()[0];
      row.rgba.assign(4 * static_cast<size_t>(runs.back()[1] - row.first), 0.0f);
      for (const auto& [first, last] : runs) {
        std::vector<float> pixels(3 * static_cast<size_t>(last - first));
        fill_testcard_pixels(card, video.prototype.eyes[i].eye, first, y, pixels);
        float* out = &row.rgba[4 * static_cast<size_t>(first - row.first)];
        for (size_t k = 0; k < pixels.size(); k += 3, out += 4) {
          std::copy_n(&pixels[k], 3, out);
          out[3] = 1.0f;
        }
      }
    });
  }
  auto frame = std::make_shared<VideoFrame>(video.still->extent(), video.packing);
  copy_planes(video.still->planes(), video.still->extent(), frame->planes());
  lay_cover(cover, video.prototype, {}, video.still->planes(), frame->planes());
  return frame;
}

// --- sound -----------------------------------------------------------------------------------------------------------

static std::string little(uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; i++) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string testcard_sound(int frames, double fps) {
  const int rate = 48000, count = static_cast<int>(std::lround(frames / fps * rate));
  std::vector<int16_t> samples(static_cast<size_t>(count));
  const int length = static_cast<int>(std::lround(flash_frames(fps) / fps * rate));
  for (int second = 0; first_frame_of(second, fps) < frames; second++) {
    const auto start = static_cast<int>(std::lround(first_frame_of(second, fps) / fps * rate));
    for (int i = 0; i < length && start + i < count; i++) {
      const double edge = std::min({1.0, i / 48.0, (length - i) / 48.0});  // fades over a millisecond to avoid clicks
      const double value = 12000.0 * edge * std::sin(2.0 * std::numbers::pi * 1000.0 * i / rate);
      samples[static_cast<size_t>(start + i)] = static_cast<int16_t>(std::lround(value));
    }
  }
  const auto bytes = static_cast<uint32_t>(2 * samples.size());
  std::string wav = "RIFF" + little(36 + bytes, 4) + "WAVEfmt " + little(16, 4) + little(1, 2) + little(1, 2) +
                    little(rate, 4) + little(2 * rate, 4) + little(2, 2) + little(16, 2) + "data" + little(bytes, 4);
  for (const int16_t sample : samples) wav += little(static_cast<uint16_t>(sample), 2);
  return wav;
}

// --- the video -------------------------------------------------------------------------------------------------------

void write_testcard_video(const TestcardVideo& video, const VideoPlan& plan, int frames, EncodeOptions options,
                          const std::string& path, const Progress& progress) {
  AtomicFile sound(path + ".wav");
  if (options.sound.empty()) {
    const std::string wav = testcard_sound(frames, video.rate.value());
    std::fwrite(wav.data(), 1, wav.size(), sound.stream());
    sound.finish();
    options.sound = sound.temporary();  // removed when no longer needed
  }
  int next = 0;
  const auto pending = [&]() -> std::optional<PendingFrame> {
    if (next == frames) return std::nullopt;
    const int number = next++;
    return PendingFrame{{number, 1}, [&video, number] { return testcard_frame(video, number); }};
  };
  write_video({plan.size, options, plan.metadata, frames, 3 * video.still->bytes()}, pending, path, progress);
}

}  // namespace ods
