// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/denoise_job.h"

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"

namespace {

constexpr const char* kDenoiseExamples =
    "  ods denoise noisy.exr -o clean.exr\n"
    "  ods denoise noisy.exr -o clean_TB.png --exposure 0.5\n"
    "  ods denoise other_TB.exr -o clean_TB.exr --half-a halfA --half-b halfB";

constexpr const char* kDenoiseSummary =
    "Removes the noise of a rendered picture with the help of statistics: the variance of each pixel, or two pictures\n"
    "of half of the samples each. Albedo, normals and depth help if the file has them. Both eyes are denoised\n"
    "together. The more samples there are, the less is changed.";

void add_input_options(Options& options, DenoiseJob& job) {
  options.argument(ValueKind::input_file("IN"), job.input, "input file: .exr; %V in the name reads one file per eye");
  options.group("Input, if it is not detected");
  options.text("--variance", "NAME", job.layers.variance, "layer with the variance of each pixel's mean");
  options.text("--half-a", "NAME", job.layers.half_a, "layer with the mean of half of the samples");
  options.text("--half-b", "NAME", job.layers.half_b, "layer with the mean of the other half");
  options.custom(
      "--projection", "NAME", "",
      [&](const std::string& name) { job.known.projection = projection_by_name("--projection", name); },
      "its projection");
  add_input_layout_option(options, job.known.layout, "its layout");
}

void add_output_options(Options& options, DenoiseJob& job, bool& alone) {
  options.group("Output");
  options.text(
      "-o,--output", ValueKind::output_file(), job.output,
      "output file: .exr keeps all layers, and the noisy colour as layer raw; also .png .jpg .tif .webp .hdr; %V "
      "in the name writes one file per eye");
  options.flag("--each-eye", alone, "denoise each eye alone");
  options.flag("--oidn", job.oidn, "use Intel Open Image Denoise, if it is installed; it needs no statistics");
  add_layout_option(options, job.layout,
                    "how both eyes share the new file; by default from its name (_TB), else the input's",
                    "--to-layout");
  add_display_options(options, job.display);
  options.group("Console");
  options.number("--threads", job.options.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, job.progress);
}

}  // namespace

DenoiseJob parse_denoise(Options& options) {
  DenoiseJob job;
  bool alone = false;
  options.describe(kDenoiseSummary, kDenoiseExamples);
  add_input_options(options, job);
  add_output_options(options, job, alone);
  options.parse();
  if (job.output.empty()) throw UsageError("no output file: add -o picture.exr");
  if (job.layers.half_a.empty() != job.layers.half_b.empty()) throw UsageError("--half-a and --half-b go together");
  if (!job.layers.half_a.empty() && !job.layers.variance.empty()) {
    throw UsageError("--variance or --half-a with --half-b, not both");
  }
  job.layers.needed = !job.oidn;
  job.options.both_eyes = !alone;
  return job;
}
