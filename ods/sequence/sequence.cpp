// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ods/base/error.h"
#include "ods/files/frames.h"
#include "ods/kernel/random.h"
#include "ods/sequence/denoised_frames.h"
#include "ods/sequence/frame_renderer.h"
#include "ods/sequence/shared_frames.h"

namespace ods {

std::vector<SequenceFrame> make_frames(const SequenceOptions& options, const std::vector<int>& numbers,
                                       const std::string& pattern, bool changing_grain) {
  const std::optional<FrameNames> names = frame_names(pattern);
  if (!names) throw Error(ErrorKind::kUsage, fmt::format("'{}' has no place for the frames' numbers: ####", pattern));
  std::vector<SequenceFrame> frames;
  for (const int number : numbers) {
    const uint32_t own = hash_pair(options.render.seed, static_cast<uint32_t>(number));
    frames.push_back({number, (number - options.first_frame) / options.fps, names->path(number), changing_grain ? own : options.render.seed});
  }
  return frames;
}

// make: gets an index in `all`, and where it is in the order of work.
static size_t make_all(const std::vector<SequenceFrame>& all, const std::vector<size_t>& missing, bool shared,
                       const SequenceProgress& progress, std::string_view end,
                       const std::function<void(size_t index, size_t number)>& make) {
  size_t made = 0;
  if (!shared) {
    for (const size_t index : missing) make(index, made++);
    return made;
  }
  std::vector<SharedFrame> files;
  for (const size_t index : missing) files.push_back({all[index].number, all[index].path + std::string(end)});
  make_shared_frames(
      files, [&](size_t i) { make(missing[i], i), made++; }, progress.waiting);
  return made;
}

size_t render_sequence(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                       const std::vector<size_t>& missing, bool shared, const SequenceProgress& progress) {
  const auto saved = [&](const Rendered& frame) {
    if (progress.saved) progress.saved(frame);
  };
  const auto report = [&](double done, size_t index) {
    if (progress.report) progress.report(done, index);
  };
  if (renderer.draws_on_neighbours()) {
    DenoisedFrames frames(renderer, all, missing);
    return make_all(all, missing, shared, progress, "", [&](size_t index, size_t) {
      saved(frames.make(index, [&](double done) { report(done, index); }));
    });
  }
  const auto count = static_cast<double>(missing.size());
  return make_all(all, missing, shared, progress, "", [&](size_t index, size_t number) {
    saved(
        renderer.render(all[index], [&](double done) { report((static_cast<double>(number) + done) / count, index); }));
  });
}

void render_raw_sequence(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                         const std::vector<size_t>& missing, const SequenceProgress& progress) {
  const auto count = static_cast<double>(missing.size());
  make_all(all, missing, true, progress, kRawEnd, [&](size_t index, size_t number) {
    renderer.keep_raw(all[index], [&](double done) {
      if (progress.report) progress.report((static_cast<double>(number) + done) / count, index);
    });
    if (progress.saved) progress.saved({{raw_path(all[index])}, 0.0});
  });
}

}  // namespace ods
