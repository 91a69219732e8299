// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/camera/stitch_job.h"

#include <cstdio>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/eye_options.h"
#include "cli/options/picture_options.h"
#include "cli/options/time_options.h"

static constexpr const char* kStitchExamples =
    "  ods stitch rig.json 'views/####.exr' -o picture.exr\n"
    "  ods stitch rig.json 'views/####.exr' --list-missing       which views to render (again)\n"
    "  ods stitch rig.json 'views/####.png' -o preview.png --partial\n"
    "  ods stitch rig.json 'views/####/####.exr' -o 'shot.####.exr' --frames 1-100   folders are frames";

static void set_sheet(const std::string& word, ods::ViewFiles& views) {
  char rest = 0;
  const int found = std::sscanf(word.c_str(), "%6dx%6d%c", &views.columns, &views.rows, &rest);
  const bool legal = found == 2 && views.columns > 0 && views.rows > 0;
  if (!legal) throw UsageError("--sheet is COLUMNSxROWS, as 8x4, not '" + word + "'");
}

static void set_merge(const std::string& word, StitchJob& job) {
  job.merge_limit = parse_auto_merge(word);
  if (!job.merge_limit)
    throw UsageError("--merge of ods stitch is auto or auto,MINUTES: any other is planned by ods rig");
}

StitchJob parse_stitch(Options& options) {
  StitchJob job;
  options.describe("Combines the views of a rig (made by ods rig) into a stereo 360 picture.", kStitchExamples);
  options.argument(ValueKind::input_file("RIG"), job.rig_file, "the rig file written by ods rig");
  options.argument(ValueKind::input_file("VIEWS"), job.views.names,
                   "the views' file names, with #### for the view's number; %V is the eye");
  options.group("Picture");
  options.text("-o,--output", ValueKind::output_file(), job.output,
               "output file: .exr .png .jpg .tif .webp .hdr; .exr keeps layers and depth");
  add_layout_option(options, job.layout, "how both eyes share the file; by default as in the rig");
  add_display_options(options, job.display);
  options.custom(
      "--merge", "auto[,MINUTES]", "", [&](const std::string& word) { set_merge(word, job); },
      "reduce the eye distance towards the poles by the views' depth, as ods convert does; any other merge is the "
      "rig's");
  options.flag("--sidecar", job.save.sidecar, "also write the camera to picture.camera.json");
  options.group("Views");
  options.text("--frames", "RANGE", job.frames,
               "frames to stitch; the views' folder has the frame's number: 'views/####/####.exr'");
  options.text("--only", "LIST|I/N", job.only,
               "stitch only these frames, or the I-th of N shares of them, as one of several processes");
  options.flag("--skip-existing", job.skip_existing,
               "do not stitch frames whose files exist; several processes with this option share the rest");
  options.custom(
      "--sheet", "CxR", "", [&](const std::string& word) { set_sheet(word, job.views); },
      "each file is a contact sheet with this many columns and rows of views, row by row");
  options.flag("--by-columns", job.views.by_columns, "the sheet's views are ordered column by column");
  options.flag("--own-normals", job.views.own_normals,
               "the views' normals are in camera space; convert them to world space");
  options.flag("--partial", job.partial, "stitch even if views are missing; their parts stay black");
  options.flag("--list-missing", job.list_missing, "only print which views to render again, as a frame range");
  options.text("--report", ValueKind::output_file(), job.report,
               "write a picture of the seams between slits, and print how visible they are");
  options.number("--threads", job.threads, 0, 1024, "number of threads; 0: all processors");
  options.group("Console");
  add_progress_options(options, job.progress);
  options.parse();
  if (job.output.empty() && !job.list_missing) throw UsageError("no output file: add -o picture.exr");
  if (job.skip_existing && job.frames.empty()) throw UsageError("--skip-existing needs --frames");
  if (!job.only.empty() && job.frames.empty()) throw UsageError("--only needs --frames");
  if (job.merge_limit && !job.frames.empty()) {
    throw UsageError(
        "--merge auto is for one picture: stitch the frames to .exr, then ods convert --merge auto makes them "
        "one steady merge");
  }
  check_only(job.only);
  job.given = options.given_words();
  return job;
}
