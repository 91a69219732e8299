// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/stitch_job.h"

#include <cstdio>

#include "cli/console.h"
#include "cli/form_options.h"
#include "cli/long_job.h"

static constexpr const char* kExamples =
    "  ods stitch rig.json 'views/####.exr' -o picture.exr\n"
    "  ods stitch rig.json 'views/####.exr' --list-missing       what is to be rendered (again)\n"
    "  ods stitch rig.json 'views/####.png' -o look.png --partial\n"
    "  ods stitch rig.json 'views/####/####.exr' -o 'shot.####.exr' --frames 1-100   folders are frames";

static void set_sheet(const std::string& word, ods::ViewFiles& views) {
  char rest = 0;
  const int found = std::sscanf(word.c_str(), "%6dx%6d%c", &views.columns, &views.rows, &rest);
  const bool legal = found == 2 && views.columns > 0 && views.rows > 0;
  if (!legal) throw UsageError("--sheet is COLUMNSxROWS, as 8x4, not '" + word + "'");
}

bool read_stitch_job(StitchJob& job, int argc, char** argv) {
  Options options("stitch", "Puts the views of a rig (ods rig) together to a stereo 360 picture.", kExamples);
  options.argument("RIG", job.rig_file, "what ods rig wrote");
  options.argument("VIEWS", job.views.names, "the views' files, a mark (####) for their number; %V for the eye's name");
  options.group("Picture");
  options.text("-o,--output", "FILE", job.output, ".exr .png .jpg .tif .webp .hdr; layers and depth stay in .exr");
  add_layout_option(options, job.layout, "how two eyes share the file, by default top-bottom (vr180: side-by-side)");
  options.number("--exposure", job.save.exposure, -30.0f, 30.0f, "stops; .hdr and .exr keep the views' light");
  options.choice("--tone", job.save.tone, ods::kToneCurves, ods::tone_curve_name,
                 "tone curve, of views that are light");
  options.flag("--sidecar", job.save.sidecar, "write the camera beside the picture");
  options.group("Views");
  options.text("--frames", "RANGE", job.frames,
               "a film: a mark in the name of the views' folder is the frame's number");
  options.flag("--skip-existing", job.skip_existing, "frames that are there stay");
  options.custom(
      "--sheet", "CxR", "", [&](const std::string& word) { set_sheet(word, job.views); },
      "every file holds so many columns and rows of views, row by row");
  options.flag("--by-columns", job.views.by_columns, "column by column: a strip for every eye, or pieces of one");
  options.flag("--own-normals", job.views.own_normals,
               "the views' normals are along their own axes, not the world's: they become the world's");
  options.flag("--partial", job.partial, "what views are missing stays black");
  options.flag("--list-missing", job.list_missing, "only say which views to render again, as a range of frames");
  options.text("--report", "FILE", job.report, "a picture of what borders of slits show, and its measure");
  options.number("--threads", job.threads, 0, 1024, "0: all processors");
  options.group("Console");
  add_progress_options(options, job.progress);
  if (!options.parse(argc, argv)) return false;
  console.json = job.progress == ProgressMode::kJson;
  job.has_tone = options.given("--tone");
  if (job.output.empty() && !job.list_missing) throw UsageError("where to? -o picture.exr");
  if (job.skip_existing && job.frames.empty()) throw UsageError("--skip-existing is for --frames");
  return true;
}
