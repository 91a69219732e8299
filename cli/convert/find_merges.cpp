// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods convert --merge auto of frames and videos: their depth is looked at before anything is converted.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/console/console.h"
#include "cli/convert/convert_job.h"
#include "cli/options/eye_options.h"
#include "ods/base/pipeline.h"

namespace {

// A picture between reading its depth and computing its shares.
struct Look {
  int picture = 0;
  std::optional<ods::StoredPicture> header;
  ods::DepthFootage::Give give;  // none: the file of the picture has its depth
  std::vector<float> shares;
};

// Uses the depth unsharpened: the edges of the pictures are not needed here, so no video is decoded.
class Looks {
 public:
  Looks(const ConvertJob& job, int step) : job_(job), step_(step), header_(job.picture) {
    if (job.given.depth.path.empty()) return;
    ods::DepthOptions options = job.given.depth.options;
    options.edges = ods::DepthEdges::kSoft;
    depth_.emplace(job.given.depth.path, job.picture, options, job.given.span(), first_of_all(job));
  }

  // The next look: every step-th picture, and the last one.
  bool take(Look& look) {
    for (; !is_over_; next_++) {
      std::optional<ods::DepthFootage::Give> give = next_depth();
      is_over_ = !give;
      const bool is_look = is_over_ ? next_ > 0 && (next_ - 1) % step_ != 0 : next_ % step_ == 0;
      if (!is_over_) last_ = std::move(*give);
      if (!is_look) continue;
      look.picture = is_over_ ? next_ - 1 : next_;
      look.give = last_, look.header = header_;
      next_++;
      return true;
    }
    return false;
  }

  void judge(Look& look) const {
    if (look.give) {
      look.give(*look.header);
    } else {
      const ods::FrameFiles all{job_.files.pattern, job_.every_frame};
      look.header = ods::open_frame(all, static_cast<size_t>(look.picture), job_.picture);
      refuse_impossible(job_, *look.header);
    }
    look.shares = ods::comfortable_shares(ods::seen_by_eyes(*look.header), job_.target.camera,
                                          *job_.given.camera.changes.merge_limit);
    look.header.reset();
  }

 private:
  // Returns nullopt if there are no more pictures, and an empty function if the picture's file has the depth.
  std::optional<ods::DepthFootage::Give> next_depth() {
    const bool has_frames = job_.kind == ods::FootageKind::kFrames;
    if (has_frames && static_cast<size_t>(next_) >= job_.every_frame.size()) return std::nullopt;
    if (!depth_) return ods::DepthFootage::Give();
    if (next_ > 0 && ods::footage_kind(job_.given.depth.path) == ods::FootageKind::kPicture) return std::nullopt;
    std::optional<int> number;
    if (has_frames) number = job_.every_frame[static_cast<size_t>(next_)];
    return depth_->next_if_any(number);
  }

  const ConvertJob& job_;
  int step_, next_ = 0;
  bool is_over_ = false;
  ods::StoredPicture header_;
  std::optional<ods::DepthFootage> depth_;
  ods::DepthFootage::Give last_;
};

}  // namespace

void find_merges(ConvertJob& job) {
  if (!job.given.camera.changes.merge_limit || job.target.eyes[0] == ods::kMono) return;
  if (!job.turns.empty()) {
    throw UsageError("--merge auto and --stabilize exclude each other: stabilize the video and its depth first");
  }
  const ods::FrameRate rate = job.footage ? job.footage->stream().rate : job.given.video.rate;
  const int step = std::max(1, static_cast<int>(std::lround(ods::kLookSeconds * rate.value())));
  Looks looks(job, step);
  std::vector<std::vector<float>> shares;
  constexpr size_t kAtOnce = 4;
  ods::run_pipeline<Look>(
      kAtOnce, [&](Look& look) { return looks.take(look); }, [&](Look& look) { looks.judge(look); },
      [&](Look& look) { shares.push_back(std::move(look.shares)); });
  if (shares.empty()) return;  // the conversion reports that there is no picture
  job.merges.emplace(shares, step);
  const ods::Image minimum = job.merges->minimum();
  note(merge_by_depth_text(minimum) + (job.merges->varies() ? ", where the depth allows least; more elsewhere" : ""));
  ods::use_merge_map(job.target.camera, minimum);
}
