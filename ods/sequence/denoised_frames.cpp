// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/denoised_frames.h"

#include <algorithm>
#include <set>
#include <utility>

#include "ods/sequence/finish_picture.h"

namespace ods {
namespace {

// The indices of a frame and those beside it: first .. last.
std::pair<size_t, size_t> reach_of(size_t index, size_t count) {
  return {index == 0 ? 0 : index - 1, std::min(index + 1, count - 1)};
}

}  // namespace

DenoisedFrames::DenoisedFrames(FrameRenderer& renderer, const std::vector<SequenceFrame>& all,
                               const std::vector<size_t>& wanted)
    : renderer_(renderer), all_(all) {
  std::set<size_t> needed;
  for (const size_t index : wanted) {
    const auto [first, last] = reach_of(index, all.size());
    for (size_t i = first; i <= last; i++) needed.insert(i);
  }
  needed_ = needed.size();
}

void DenoisedFrames::render(size_t index, const FrameRenderer::Report& report) {
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

Rendered DenoisedFrames::make(size_t index, const FrameRenderer::Report& report) {
  const auto [first, last] = reach_of(index, all_.size());
  if (!window_.empty() && first < window_.begin()->first) window_.clear();  // back to a frame that others left
  window_.erase(window_.begin(), window_.lower_bound(first));
  for (size_t i = first; i <= last; i++) {
    if (!window_.contains(i)) render(i, report);
  }
  Neighbour& frame = window_.at(index);
  std::vector<FrameBeside> beside;
  const auto add = [&](size_t other, const auto& places) {
    const RawFrame& raw = window_.at(other).raw;
    if (other != index) beside.push_back({raw.picture, raw.camera, places, all_[other].seed == all_[index].seed});
  };
  add(first, frame.before);
  add(last, frame.after);
  const double samples = frame.raw.picture.samples_taken;
  return {finish_picture(renderer_.options().finish, renderer_.options().render, frame.raw.camera, frame.raw.picture,
                         all_[index].path, beside),
          samples};
}

}  // namespace ods
