// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos decoded by the ffmpeg program, sample by sample.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "ods/camera/layout.h"

namespace ods {

inline bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

inline std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> bytes{};
  while (const size_t size = std::fread(bytes.data(), 1, bytes.size(), pipe)) text.append(bytes.data(), size);
  pclose(pipe);
  return text;
}

struct DecodedVideo {
  Extent size;
  std::string format;  // yuv420p10le
  std::string bytes;
  int bits = 8;
  Extent block{1, 1};  // pixels that share chroma

  size_t plane_size(size_t plane) const {
    const size_t samples = static_cast<size_t>(size.width / (plane ? block.width : 1)) *
                           static_cast<size_t>(size.height / (plane ? block.height : 1));
    return samples * (bits > 8 ? 2 : 1);
  }
  size_t frame_size() const { return plane_size(0) + 2 * plane_size(1); }
  size_t frames() const { return bytes.size() / frame_size(); }

  // Scaled to 8 bits.
  double sample(size_t frame, size_t plane, int x, int y) const {
    const size_t row = static_cast<size_t>(size.width / (plane ? block.width : 1));
    size_t at =
        static_cast<size_t>(y / (plane ? block.height : 1)) * row + static_cast<size_t>(x / (plane ? block.width : 1));
    size_t start = frame * frame_size();
    for (size_t i = 0; i < plane; i++) start += plane_size(i);
    if (bits == 8) return static_cast<unsigned char>(bytes.at(start + at));
    at = start + 2 * at;
    const int value = static_cast<unsigned char>(bytes.at(at)) | static_cast<unsigned char>(bytes.at(at + 1)) << 8;
    return value / std::exp2(bits - 8);
  }

  // The displayed colour, 0..255, by BT.709 of limited range.
  std::array<double, 3> codes(size_t frame, int x, int y) const {
    const double luma = (sample(frame, 0, x, y) - 16.0) / 219.0 * 255.0;
    const double cb = (sample(frame, 1, x, y) - 128.0) / 224.0 * 255.0;
    const double cr = (sample(frame, 2, x, y) - 128.0) / 224.0 * 255.0;
    const double red = luma + 1.5748 * cr, blue = luma + 1.8556 * cb;
    return {red, (luma - 0.2126 * red - 0.0722 * blue) / 0.7152, blue};
  }
};

inline DecodedVideo decode_video(const std::string& path) {
  DecodedVideo video;
  std::istringstream words(output_of(
      "ffprobe -v error -select_streams v:0 -show_entries stream=width,height,pix_fmt -of default=nk=1:nw=1 " + path));
  words >> video.size.width >> video.size.height >> video.format;
  video.bits = video.format.ends_with("12le") ? 12 : video.format.ends_with("10le") ? 10 : 8;
  if (video.format.starts_with("yuv420")) video.block = {2, 2};
  if (video.format.starts_with("yuv422")) video.block = {2, 1};
  video.bytes = output_of("ffmpeg -v error -i " + path + " -map 0:v:0 -f rawvideo -");
  return video;
}

}  // namespace ods
