// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/make_video.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <set>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/files/read_file.h"
#include "ods/video/container/complete_metadata.h"
#include "ods/video/write_video.h"

namespace ods {

// --- the files -------------------------------------------------------------------------------------------------------

static FrameNames names_in(const std::string& pattern) {
  if (const std::optional<FrameNames> names = frame_names(pattern)) return *names;
  if (container_of_path(pattern)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' is a video, not frames; ods convert encodes a video again", pattern));
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("'{}' has no placeholder for the frame number; write it like shot.####.exr", pattern));
}

std::string FrameFiles::path(size_t index) const {
  return names_in(pattern).path(frames[index]);
}

// The file patterns of a frame: one, or two if each eye has its own.
static std::vector<std::string> patterns_of(const std::string& pattern) {
  if (!names_eye(pattern)) return {pattern};
  return {path_for_eye(pattern, kLeft), path_for_eye(pattern, kRight)};
}

// A list of frames for messages, which must stay one line.
static std::string some_of(const std::vector<int>& frames) {
  const size_t kLongest = 200;
  const std::string text = frames_text(frames);
  if (text.size() <= kLongest) return text;
  return fmt::format("{} ... ({} in all)", text.substr(0, text.rfind(',', kLongest)), frames.size());
}

FrameFiles find_frames(const std::string& pattern, const std::optional<std::vector<int>>& wanted) {
  std::set<int> all;
  std::vector<std::vector<int>> found;
  const std::vector<std::string> patterns = patterns_of(pattern);
  for (const std::string& each : patterns) {
    found.push_back(frames_on_disk(names_in(each)));
    all.insert(found.back().begin(), found.back().end());
  }
  if (all.empty()) throw Error(ErrorKind::kInput, fmt::format("there is no file like '{}'", pattern));
  const std::vector<int> there(all.begin(), all.end()), holes = gaps(there);
  all.insert(holes.begin(), holes.end());
  FrameFiles files{pattern, wanted.value_or(std::vector<int>(all.begin(), all.end()))};
  std::string missing;
  for (size_t i = 0; i < patterns.size(); i++) {
    const std::set<int> here(found[i].begin(), found[i].end());
    std::vector<int> absent = files.frames;
    std::erase_if(absent, [&](int frame) { return here.contains(frame); });
    if (absent.empty()) continue;
    missing += fmt::format("{}{} of '{}'", missing.empty() ? "" : ", and ", some_of(absent), patterns[i]);
  }
  if (missing.empty()) return files;
  throw Error(ErrorKind::kInput, fmt::format("frames are missing: {} (found {})", missing, some_of(there)));
}

// --- the plan --------------------------------------------------------------------------------------------------------

// Reads only a PNG's first bytes, because opening it would scan the whole file.
static Extent size_of(const std::string& path) {
  const std::vector<unsigned char> start = read_start(path, 24);
  const std::string_view bytes(reinterpret_cast<const char*>(start.data()), start.size());
  if (bytes.size() == 24 && bytes.starts_with("\x89PNG\r\n\x1a\n")) {
    return {static_cast<int>(get_number(bytes, 16, 4)), static_cast<int>(get_number(bytes, 20, 4))};
  }
  const FileInfo info = read_info(path);
  return {info.width, info.height};
}

// Throws if the size in a frame's header differs from the first frame's.
static void check_sizes(const FrameFiles& files) {
  for (const std::string& pattern : patterns_of(files.pattern)) {
    const FrameNames names = names_in(pattern);
    std::vector<Extent> sizes(files.frames.size());
    tbb::parallel_for(size_t{0}, sizes.size(), [&](size_t i) { sizes[i] = size_of(names.path(files.frames[i])); });
    std::vector<int> others;
    Extent other;
    for (size_t i = 0; i < sizes.size(); i++) {
      if (sizes[i].width == sizes[0].width && sizes[i].height == sizes[0].height) continue;
      if (others.empty()) other = sizes[i];
      others.push_back(files.frames[i]);
    }
    if (others.empty()) continue;
    throw Error(
        ErrorKind::kInput,
        fmt::format("frames {} of '{}' differ in size from the first: {} has {}x{} pixels, not {}x{}", some_of(others),
                    pattern, others[0], other.width, other.height, sizes[0].width, sizes[0].height));
  }
}

static Layout requested_layout(Layout own, std::optional<Layout> choice) {
  if (!choice || *choice == own) return own;
  const Extent squeeze = squeeze_of(own, 2);
  if (squeeze.width * squeeze.height > 1) {
    throw Error(ErrorKind::kUsage,
                fmt::format("the frames are {} and cannot become {}; unsqueeze them with ods convert", layout_name(own),
                            layout_name(*choice)));
  }
  return *choice;
}

VideoPlan plan_eyes(Extent eye, size_t count, Layout layout, const ProjectionSetting& projection) {
  VideoPlan plan;
  plan.eye = eye;
  plan.eyes = count;
  plan.layout = layout;
  plan.size = packed_size(layout, eye, static_cast<int>(count));
  plan.metadata.stereo = count == 1 ? VideoStereo::kOneView : video_stereo(layout);
  plan.metadata.source = "Omnistereo";
  try {
    set_projection(plan.metadata, projection);
  } catch (const Error& error) {
    plan.notes.push_back(fmt::format("{}; it gets only its layout as metadata", error.what()));
  }
  return plan;
}

VideoPlan plan_video(const FrameFiles& files, const FormatHint& known, std::optional<Layout> layout) {
  check_sizes(files);
  OpenOptions options;
  options.format = known;
  options.color_only = true;
  const StoredPicture first = open_picture(files.path(0), options);
  const Layout own = requested_layout(video_layout(first), layout);
  VideoPlan plan = plan_eyes(first.size, first.eyes.size(), own, first.camera.projection);
  if (first.has_ipd && first.eyes.size() == 2) plan.metadata.ipd = static_cast<double>(first.camera.ipd);
  plan.known.layout = first.layout;
  plan.known.camera = first.camera;
  for (const std::string& guess : first.guesses) plan.notes.push_back(fmt::format("{}: {}", files.path(0), guess));
  return plan;
}

void check_packing(const VideoPlan& plan, const Packing& packing) {
  const Extent block = chroma_block(packing.chroma);
  if (plan.eye.width % block.width == 0 && plan.eye.height % block.height == 0) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("eyes of {}x{} pixels cannot become a video with chroma {}: their sides must be even",
                          plan.eye.width, plan.eye.height, chroma_name(packing.chroma)));
}

// --- the video -------------------------------------------------------------------------------------------------------

static std::shared_ptr<VideoFrame> read_frame(const std::string& path, const VideoPlan& plan,
                                              const DisplayTransform& display, const Packing& packing) {
  OpenOptions options;
  options.format = plan.known;
  options.color_only = true;
  const StoredPicture picture = open_picture(path, options);
  const Extent size = picture.size;
  if (size.width != plan.eye.width || size.height != plan.eye.height || picture.eyes.size() != plan.eyes) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' is not like the first frame: {} of {}x{} pixels, not {} of {}x{}", path,
                            picture.eyes.size(), size.width, size.height, plan.eyes, plan.eye.width, plan.eye.height));
  }
  auto frame = std::make_shared<VideoFrame>(plan.size, packing);
  fill_frame(picture, plan.layout, display, *frame);
  return frame;
}

TagResult make_video(const FrameFiles& files, const VideoPlan& plan, const DisplayTransform& display,
                     const EncodeOptions& options, const std::string& path, const Progress& progress) {
  assert(!files.frames.empty() && container_of_path(path));
  check_packing(plan, options.packing);
  const size_t pixels = static_cast<size_t>(plan.size.width) * static_cast<size_t>(plan.size.height);
  const size_t decoded = pixels * 4 * sizeof(float);  // a decoded frame takes up to four floats per pixel
  const NewVideo video{plan.size, options, plan.metadata, static_cast<int>(files.frames.size()), decoded, {}};
  size_t next = 0;
  const auto frames = [&]() -> std::optional<PendingFrame> {
    if (next == files.frames.size()) return std::nullopt;
    const size_t index = next++;
    const auto make = [&, index] { return read_frame(files.path(index), plan, display, options.packing); };
    return PendingFrame{{static_cast<int64_t>(index), 1}, make};
  };
  return write_video(video, frames, path, progress).tags;
}

}  // namespace ods
