// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/sequence.h"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "ods/base/error.h"
#include "ods/files/frames.h"
#include "ods/kernel/random.h"
#include "ods/picture/save.h"
#include "ods/sequence/denoised_frames.h"
#include "ods/sequence/frame_renderer.h"
#include "ods/sequence/shared_frames.h"

namespace ods {

std::vector<SequenceFrame> make_frames(const SequenceOptions& options, const std::vector<int>& numbers,
                                       const std::string& pattern) {
  const std::optional<FrameNames> names = frame_names(pattern);
  if (!names) throw Error(ErrorKind::kUsage, fmt::format("'{}' has no place for the frames' numbers: ####", pattern));
  const bool changes = options.changing_grain.value_or(moves(options.camera.move));
  const uint32_t seed = options.render.seed;
  std::vector<SequenceFrame> frames;
  for (const int number : numbers) {
    const uint32_t own = hash_pair(seed, static_cast<uint32_t>(number));
    const double time = (number - options.first_frame) / options.fps;
    frames.push_back({number, time, names->path(number), changes ? own : seed});
  }
  return frames;
}

std::vector<size_t> choose_frames(const std::vector<SequenceFrame>& all, const std::vector<int>& numbers,
                                  bool skip_existing) {
  const std::set<int> wanted(numbers.begin(), numbers.end());
  std::vector<size_t> chosen;
  for (size_t i = 0; i < all.size(); i++) {
    if (!wanted.contains(all[i].number)) continue;
    if (skip_existing && is_saved(all[i].path)) {
      remove_dead_claim(all[i].path);
    } else {
      chosen.push_back(i);
    }
  }
  return chosen;
}

size_t render_sequence(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                       const std::vector<size_t>& missing, Sink sink, const SequenceProgress& progress) {
  std::optional<DenoisedFrames> denoised;
  if (sink != Sink::kRaw && renderer.draws_on_neighbours()) denoised.emplace(renderer, all, missing);
  size_t made = 0;
  const auto make = [&](size_t place) {
    const size_t index = missing[place];
    const SequenceFrame& frame = all[index];
    const FrameAtWork at_work{static_cast<int>(place) + 1, static_cast<int>(missing.size()), frame.path};
    const auto whole = [&](double done) {
      if (progress.report) progress.report(done, at_work);
    };
    const auto part = [&](double done) {
      whole((static_cast<double>(place) + done) / static_cast<double>(missing.size()));
    };
    const Rendered rendered = denoised             ? denoised->make(index, whole)
                              : sink == Sink::kRaw ? renderer.keep_raw(frame, part)
                                                   : renderer.render(frame, part);
    made++;
    if (progress.saved) progress.saved(rendered);
  };
  if (sink == Sink::kFiles) {
    for (size_t place = 0; place < missing.size(); place++) make(place);
    return made;
  }
  std::vector<SharedFrame> files;
  for (const size_t index : missing) {
    files.push_back({all[index].number, sink == Sink::kRaw ? raw_path(all[index]) : all[index].path});
  }
  make_shared_frames(files, make, progress.waiting);
  return made;
}

}  // namespace ods
