// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on videos whose pictures are two tracks: any bytes give joined pictures of the size that their header
// announces, or an error.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_joined_reader
//   build/fuzz/fuzz_joined_reader -max_len=32768 -timeout=20 folder/of/small/videos
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/video/joined_tracks.h"

constexpr int64_t kManyPixels = 1 << 20;  // decoding more is too slow for many runs

static void read_pictures(const std::string& path) {
  const ods::VideoFile video = ods::read_video_file(path);
  const ods::ChosenPictures chosen = ods::choose_pictures(video, ods::Layout::kSideBySide, path);
  if (int64_t{chosen.track.size.width} * chosen.track.size.height > kManyPixels) return;
  ods::VideoDecoder decoder(path, chosen.track.id, chosen.views, 1);
  const ods::VideoStream& stream = decoder.stream();
  if (int64_t{stream.size.width} * stream.size.height > kManyPixels) return;
  for (int i = 0; i < 3; i++) {
    const auto frame = decoder.next();
    if (!frame) return;
    const std::byte* const row =
        frame->planes.first[0] + static_cast<size_t>(stream.size.height - 1) * frame->planes.stride[0];
    volatile std::byte seen = row[stream.size.width - 1];  // the sanitizer checks that it exists
    static_cast<void>(seen);
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    read_pictures(file.path());
  } catch (const ods::Error&) {
  }
  return 0;
}
