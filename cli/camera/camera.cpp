// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods camera: writes the camera in the language of another renderer.
#include <fmt/format.h>

#include <cstdio>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/print.h"
#include "cli/options/camera_source.h"
#include "cli/options/untested_targets.h"
#include "ods/export/camera_export.h"
#include "ods/files/atomic_file.h"
#include "ods/image/format/file_format.h"

using ods::CameraTarget;

namespace {

constexpr const char* kCameraExamples =
    "  ods camera --for povray --ipd 0.064 --merge cosine,0,90,0.2 --position 0,1.6,0 > camera.inc\n"
    "  ods camera --for blender --camera-file picture.camera.json -o match.py\n"
    "  ods camera --for json --camera-preset arnold -o arnold.camera.json";

struct CameraJob {
  CameraSource source;
  CameraTarget target = CameraTarget::kNumbers;
  std::string output;  // empty: stdout
};

CameraJob parse_camera(Options& options) {
  CameraJob job;
  options.describe(
      "Exports a camera to another renderer. A comment in the result lists what that renderer does not support.",
      kCameraExamples);
  options.group("Output");
  options.choice("--for", job.target, ods::kCameraTargetTable,
                 "the target; " + untested_targets(ods::kCameraTargetTable));
  options.text("-o,--output", ValueKind::output_file(), job.output, "output file; by default stdout");
  add_camera_source(options, job.source);
  options.group("Console");
  add_console_options(options);
  options.parse();
  return job;
}

void export_to(const CameraJob& job) {
  const auto& [given, target, output] = job;
  CameraSource source = given;
  const ods::CameraExport result = ods::export_camera(read_camera_source(source), target);
  if (!result.refusal.empty()) {
    throw UsageError(fmt::format("--for {}: {}", ods::camera_target_name(target), result.refusal));
  }
  for (const std::string& warning : result.warnings) note("unsupported: " + warning);
  if (output.empty()) {
    put_out(result.text);
    return;
  }
  if (ods::format_of_path(output)) {
    throw UsageError(fmt::format("'{}' is the name of a picture, but a camera export is a text file", output));
  }
  ods::write_file(output, result.text);
  announce_file(output);
}

}  // namespace

extern const Command kCamera = make_command<parse_camera, export_to>("camera", "export a camera to another renderer");
