// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods title: makes text with depth for a stereo 360 picture.
#include "ods/compose/title.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/compose/title_job.h"
#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/options/picture_options.h"
#include "ods/files/frames.h"

namespace {

ods::Lettering letter(const TitleJob& job, const ods::StereoCamera& stereo, ods::Extent eye) {
  ods::Lettering lettering = ods::draw_lettering(job.text, ods::lettering_em(stereo, eye, job.title), job.lettering);
  if (lettering.characters_lost > 0) {
    warn(fmt::format("no installed font has {} of its characters; try --font FILE", lettering.characters_lost));
  }
  if (lettering.stands_in) {
    note(fmt::format("the font '{}' is not installed: using {}", job.lettering.font, lettering.font));
  }
  return lettering;
}

void warn_if_too_near(const TitleJob& job, const ods::StereoCamera& stereo) {
  const float nearest = ods::nearest_comfortable(stereo, job.title.pitch);
  if (job.title.distance >= nearest) return;
  warn(
      fmt::format("at {:g} m it strains the eyes: {:.2g} m or more is comfortable there", job.title.distance, nearest));
}

void warn_if_too_wide(const ods::Title& title) {
  const float width = ods::title_width(title);
  if (width <= ods::kComfortableWidth) return;
  warn(fmt::format(
      "the text is {:.0f} degrees wide; beyond {:g}, viewers turn their heads to read it: --text-height {:.2g}, a "
      "larger distance or a line break (\\n) makes it narrower",
      width, ods::kComfortableWidth, ods::comfortable_height(title)));
}

// The opacity at the middle of a frame, timed from the start of the first.
float fade(const TitleJob& job, int frame) {
  const auto [first, last] = std::minmax_element(job.frames->begin(), job.frames->end());
  const float fps = job.fps.value_or(30.0f);
  const float at = (static_cast<float>(frame - *first) + 0.5f) / fps;
  const float left = (static_cast<float>(*last - frame) + 0.5f) / fps;
  const auto share = [](float seconds, std::optional<float> fade) { return fade > 0.0f ? seconds / *fade : 1.0f; };
  return std::clamp(std::min(share(at, job.fade_in), share(left, job.fade_out)), 0.0f, 1.0f);
}

void save(const TitleJob& job, const ods::Title& title, const ods::StereoCamera& stereo, const std::string& path) {
  const std::vector<int> eyes = ods::eye_list(job.picture.eyes);
  ods::PictureRows rows;
  rows.eye = title.eye;
  rows.eyes = eyes;
  rows.layers = {{{"R", "G", "B", "A"}}, {{"Z"}, ods::LayerRule::kNearest, ods::SampleType::kFloat}};
  rows.fill = [&](int index, int y, std::span<float> row) {
    fill_title_row(title, eyes[static_cast<size_t>(index)], y, row);
  };
  for (const std::string& file : save_picture(rows, &stereo, job.save, path)) announce_file(file);
}

void title(TitleJob job) {
  use_form(job.form, job.camera, job.picture, job.save);
  const ods::StereoCamera stereo = place_camera(job.camera);
  const ods::Extent eye{job.picture.width, job.picture.height};
  const std::vector<int> eyes = ods::eye_list(job.picture.eyes);
  ods::check_output(job.frames ? video_names(job.output).path(0) : job.output, job.save, eyes, eye);
  note_misleading_name(job.output, job.save, eyes.size(), stereo.projection);
  warn_if_too_near(job, stereo);
  ods::Title title = make_title(stereo, eye, job.title, letter(job, stereo, eye));
  warn_if_too_wide(title);
  if (!job.frames) return save(job, title, stereo, job.output);
  for (const int frame : *job.frames) {
    title.setting.opacity = job.title.opacity * fade(job, frame);
    save(job, title, stereo, video_names(job.output).path(frame));
  }
}

}  // namespace

extern const Command kTitle = make_command<parse_title, title>("title", "make a title with depth for stereo 360");
