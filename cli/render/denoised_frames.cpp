// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/denoised_frames.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "cli/render/finish_picture.h"

namespace {

// The indices of a frame and those beside it: first .. last.
std::pair<size_t, size_t> reach_of(size_t index, size_t count) {
  return {index == 0 ? 0 : index - 1, std::min(index + 1, count - 1)};
}

}  // namespace

bool draws_on_neighbours(const RenderJob& job) {
  return job.time.is_video && denoiser_of(job) == ods::Denoiser::kOwn;
}

DenoisedFrames::DenoisedFrames(const RenderJob& job, FrameRenderer& renderer, const std::vector<Frame>& all,
                               const std::set<size_t>& wanted)
    : job_(job), renderer_(renderer), all_(all) {
  std::set<size_t> needed;
  for (const size_t index : wanted) {
    const auto [first, last] = reach_of(index, all.size());
    for (size_t i = first; i <= last; i++) needed.insert(i);
  }
  needed_ = needed.size();
}

void DenoisedFrames::render(size_t index, const std::function<void(double done)>& report) {
  const auto part = [&](double done) {
    report((static_cast<double>(rendered_) + done) / static_cast<double>(needed_));
  };
  Neighbour& frame = window_[index];
  frame.raw = renderer_.render_raw(all_[index], part);
  rendered_++;
  const auto before = index == 0 ? window_.end() : window_.find(index - 1);
  if (before == window_.end()) return;
  before->second.after = renderer_.places(before->second.raw, frame.raw.time);
  frame.before = renderer_.places(frame.raw, before->second.raw.time);
}

Rendered DenoisedFrames::make(size_t index, const std::function<void(double done)>& report) {
  const auto [first, last] = reach_of(index, all_.size());
  if (!window_.empty() && first < window_.begin()->first) window_.clear();  // back to a frame that others left
  window_.erase(window_.begin(), window_.lower_bound(first));
  for (size_t i = first; i <= last; i++) {
    if (!window_.contains(i)) render(i, report);
  }
  Neighbour& frame = window_.at(index);
  std::vector<ods::FrameBeside> beside;
  const auto add = [&](size_t other, const auto& places) {
    const RawFrame& raw = window_.at(other).raw;
    if (other != index) beside.push_back({raw.picture, raw.camera, places, all_[other].seed == all_[index].seed});
  };
  add(first, frame.before);
  add(last, frame.after);
  const double samples = frame.raw.picture.samples_taken;
  return {finish_picture(job_, frame.raw.camera, frame.raw.picture, all_[index].path, beside), samples};
}
