// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames for tests of videos: the left eye red, the right eye blue, every frame slightly brighter; and sound.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "ods/files/frames.h"
#include "ods/picture/save.h"

namespace ods::made {

// The code of the strong channel of a frame.
inline int code_of(int frame) {
  return 150 + 4 * frame;
}

inline Image plain(Extent size, vec3 code) {
  Image image(size.width, size.height, 3);
  for (size_t i = 0; i < image.pixels.size(); i++) {
    image.pixels[i] = srgb_decode(code[static_cast<int>(i % 3)] / 255.0f);
  }
  return image;
}

inline Picture red_and_blue(Extent eye, int frame) {
  const float strong = static_cast<float>(code_of(frame));
  Picture picture;
  picture.eyes.resize(2);
  picture.eyes[0].eye = kLeft;
  picture.eyes[0].radiance = plain(eye, {strong, 20.0f, 20.0f});
  picture.eyes[1].eye = kRight;
  picture.eyes[1].radiance = plain(eye, {20.0f, 20.0f, strong});
  return picture;
}

inline void write_frames(const std::string& pattern, const std::vector<int>& frames, Layout layout = Layout::kTopBottom,
                         Extent eye = {128, 64}) {
  SaveOptions options;
  options.layout = layout;
  options.tone = ToneCurve::kLinear;
  for (int frame : frames) save_picture(red_and_blue(eye, frame), options, frame_names(pattern)->path(frame));
}

// A wav file with different signals per channel, such as a sine on the left and silence on the right: 16 bits, any
// number of channels.
inline std::string wav(int channels, double seconds) {
  const int rate = 48000, count = static_cast<int>(seconds * rate);
  const auto little = [](uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; i++) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
  };
  std::string data;
  for (int i = 0; i < count; i++) {
    for (int c = 0; c < channels; c++) {
      const double value = 8000.0 * std::sin(0.02 * (c + 1) * i) / (c + 1);
      data += little(static_cast<uint32_t>(static_cast<int>(value)) & 0xffff, 2);
    }
  }
  const auto words = static_cast<uint32_t>(channels);
  const std::string format = little(1, 2) + little(words, 2) + little(static_cast<uint32_t>(rate), 4) +
                             little(static_cast<uint32_t>(rate) * words * 2, 4) + little(words * 2, 2) + little(16, 2);
  const std::string body =
      "WAVEfmt " + little(16, 4) + format + "data" + little(static_cast<uint32_t>(data.size()), 4) + data;
  return "RIFF" + little(static_cast<uint32_t>(body.size()), 4) + body;
}

}  // namespace ods::made
