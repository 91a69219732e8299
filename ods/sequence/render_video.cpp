// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/render_video.h"

#include <filesystem>

#include "ods/base/error.h"
#include "ods/picture/save.h"
#include "ods/sequence/looks.h"

namespace ods {

std::vector<size_t> missing_frames(const std::vector<SequenceFrame>& all) {
  std::vector<size_t> missing;
  for (size_t i = 0; i < all.size(); i++) {
    if (!is_saved(all[i].path)) missing.push_back(i);
  }
  return missing;
}

VideoPlan encode_frames(const VideoJournal& journal, const std::vector<int>& frames, const DisplayTransform& display,
                        const EncodeOptions& encode, const std::string& path, bool keep_frames,
                        const Progress& progress) {
  const FrameFiles files = find_frames(journal.pattern(), frames);
  VideoPlan plan = plan_video(files, {}, {});
  make_video(files, plan, display, encode, path, progress);
  std::error_code ignored;
  for (size_t i = 0; i < frames.size(); i++) std::filesystem::remove(files.path(i) + std::string(kRawEnd), ignored);
  if (!keep_frames) journal.remove();
  return plan;
}

void render_video(Scene& scene, SequenceOptions options, const VideoOptions& video, const std::string& path,
                  const Progress& progress) {
  options.fps = video.encode.rate.value();
  VideoJournal journal(path, video.settings, video.restart);
  journal.plan(video.frames, video.frames);
  const std::vector<SequenceFrame> all = make_frames(options, video.frames, journal.pattern());
  FrameRenderer renderer(options, scene);
  DisplayTransform display{video.exposure.value_or(0.0f), video.tone};
  if (!video.exposure) display.exposure = suitable_exposure(renderer, all).value_or(0.0f);
  options.render.noise_exposure = display.exposure;
  SequenceProgress of_frames;
  of_frames.report = [&](double done, size_t) {
    journal.check();
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "the video was stopped");
    if (progress.report) progress.report(kRenderingShare * done);
  };
  render_sequence(renderer, all, missing_frames(all), false, of_frames);
  Progress of_encoding = progress;
  of_encoding.report = [&](double done) {
    if (progress.report) progress.report(kRenderingShare + (1.0 - kRenderingShare) * done);
  };
  encode_frames(journal, video.frames, display, video.encode, path, video.keep_frames, of_encoding);
}

}  // namespace ods
