// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/video_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/files/read_file.h"
#include "ods/video/container/matroska_file.h"
#include "ods/video/container/mp4_file.h"

namespace ods {

static std::string first_bytes(const FileInput& file) {
  return file.read(0, std::min<uint64_t>(file.size(), 16));
}

bool is_video(const std::string& path) {
  const std::vector<unsigned char> start = read_start(path, 16);
  const std::string_view bytes(reinterpret_cast<const char*>(start.data()), start.size());
  return is_mp4(bytes) || is_matroska(bytes);
}

static Error unusable(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot use '{}': {}", path, why));
}

// Returns whether the file is of the Matroska family; if not, it is of the mp4 family. Throws for other files.
static bool is_of_matroska(const FileInput& file) {
  const std::string start = first_bytes(file);
  if (is_matroska(start)) return true;
  if (is_mp4(start)) return false;
  throw unusable(file.path(), "it is not a supported video (mp4, mov, mkv, webm)");
}

VideoFile read_video_file(const std::string& path) {
  const FileInput file(path);
  try {
    return is_of_matroska(file) ? read_matroska(file) : read_mp4(file);
  } catch (const MalformedFile& broken) {
    throw unusable(path, broken.what());
  }
}

static int64_t pixels(const VideoTrack& track) {
  return int64_t{track.size.width} * track.size.height;
}

const VideoTrack& choose_track(const VideoFile& video, std::optional<int> id, const std::string& path) {
  if (video.tracks.empty()) throw unusable(path, "it has no video track");
  std::string ids;
  for (const VideoTrack& track : video.tracks) {
    if (id && track.id == static_cast<uint64_t>(*id)) return track;
    ids += fmt::format("{}{} ({}x{})", ids.empty() ? "" : ", ", track.id, track.size.width, track.size.height);
  }
  if (id) {
    throw Error(ErrorKind::kUsage, fmt::format("`track`: '{}' has no video track {}, but {}", path, *id, ids));
  }
  const auto smaller = [](const VideoTrack& a, const VideoTrack& b) { return pixels(a) < pixels(b); };
  const VideoTrack& largest = *std::max_element(video.tracks.begin(), video.tracks.end(), smaller);
  const auto as_large = [&](const VideoTrack& track) { return pixels(track) == pixels(largest); };
  if (std::count_if(video.tracks.begin(), video.tracks.end(), as_large) > 1) {
    if (small_letters(path).ends_with(".360")) {
      throw unusable(path, fmt::format("its tracks {} are not the cube of a GoPro MAX, which ods joins: GoPro's player "
                                       "exports others as one lat-long video",
                                       ids));
    }
    throw unusable(path, fmt::format("several tracks share the largest size, of {}, and their names do not tell the "
                                     "eyes: if the first one is the left eye, specify `layout` side-by-side, if the "
                                     "right one, `layout` cross-eyed; for the first one alone, `layout` separate",
                                     ids));
  }
  return largest;
}

TagResult tag_video(const std::string& path, const std::string& to, uint64_t track,
                    const std::optional<SphericalMetadata>& metadata, const OtherTags& other,
                    const std::function<void(double done)>& progress) {
  FileInput file(path);
  if (progress) {
    file.watch([&](uint64_t copied) { progress(static_cast<double>(copied) / static_cast<double>(file.size())); });
  }
  const bool matroska = is_of_matroska(file);
  AtomicFile output(to);
  TagResult result;
  try {
    result = matroska ? tag_matroska(file, output, track, metadata) : tag_mp4(file, output, track, metadata, other);
  } catch (const MalformedFile& broken) {
    throw unusable(path, broken.what());
  }
  file.give_mode(output);
  output.commit();
  return result;
}

}  // namespace ods
