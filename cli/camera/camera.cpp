// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods camera: the same camera in the words of another renderer.
#include <fmt/format.h>

#include <cstdio>

#include "cli/console/console.h"
#include "cli/console/print.h"
#include "cli/options/camera_source.h"
#include "ods/export/camera_export.h"
#include "ods/files/atomic_file.h"
#include "ods/image/format/file_format.h"

using ods::CameraTarget;

namespace {

constexpr const char* kCameraExamples =
    "  ods camera --for povray --ipd 0.064 --merge cosine,0,90,0.2 --position 0,1.6,0 > camera.inc\n"
    "  ods camera --for blender --from picture.camera.json -o match.py\n"
    "  ods camera --for json --camera-preset arnold -o arnold.camera.json";

void camera(int argc, char** argv) {
  CameraSource source;
  CameraTarget target = CameraTarget::kNumbers;
  std::string output;
  Options options(
      "camera",
      "Exports a camera to another renderer. A comment in the result says what that renderer does not support.",
      kCameraExamples);
  options.group("Output");
  options.choice("--for", target, ods::kCameraTargetTable,
                 "the target; untested in their programs: povray-fork, osl, ospray, arnold, mtoa, unity, unreal");
  options.text("-o,--output", ValueKind::output_file(), output, "output file; by default stdout");
  add_camera_source(options, source);
  options.group("Console");
  add_console_options(options);
  if (!options.parse(argc, argv)) return;
  const ods::CameraExport result = ods::export_camera(read_camera_source(source), target);
  if (!result.refusal.empty()) {
    throw UsageError(fmt::format("--for {}: {}", ods::camera_target_name(target), result.refusal));
  }
  for (const std::string& warning : result.warnings) note("not as asked: " + warning);
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

int ods_camera(int argc, char** argv) {
  return run_command([=] { camera(argc, argv); });
}
