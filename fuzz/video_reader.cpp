// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the readers of videos, and on tagging them: any bytes give a video or an error; a tagged video can be
// read again and has its tag.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_video_reader
//   build/fuzz/fuzz_video_reader -max_len=8192 folder/of/small/videos
#include <cstdlib>
#include <string>

#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/video/container/matroska_file.h"
#include "ods/video/container/mp4_file.h"

static void tag_and_read(const std::string& path, uint64_t track) {
  ods::SphericalMetadata metadata;
  metadata.stereo = ods::VideoStereo::kTopBottom;
  metadata.projection = ods::VideoProjection::kEquirect;
  ods::AtomicFile to("/dev/shm/ods-fuzz/video");  // never committed
  const ods::FileInput file(path);
  try {
    const bool is_mp4 = ods::is_mp4(file.read(0, 16));
    is_mp4 ? tag_mp4(file, to, track, metadata) : tag_matroska(file, to, track, metadata);
  } catch (const ods::MalformedFile&) {
    return;
  }
  const ods::VideoFile video = ods::read_video_file(to.temporary());
  for (const ods::VideoTrack& read : video.tracks) {
    if (read.id == track && read.v2 && read.v2->stereo == metadata.stereo) return;
  }
  std::abort();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    const ods::VideoFile video = ods::read_video_file(file.path());
    if (!video.tracks.empty()) tag_and_read(file.path(), video.tracks[0].id);
  } catch (const ods::Error&) {
  }
  return 0;
}
