// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/picture/convert_job.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/eye_options.h"
#include "cli/options/field_option.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"
#include "ods/files/atomic_file.h"
#include "ods/picture/metadata/sidecar.h"

using ods::CameraField, ods::StereoCamera, ods::Eyes, ods::Layout;

namespace {

constexpr const char* kExamples =
    "  ods convert picture.png -o cubes.png --to cube-3x2\n"
    "  ods convert picture_TB.jpg -o headset.jpg --to vr180 --width 4096\n"
    "  ods convert picture.exr -o window.png --mono --to perspective --fov 70 --yaw 30 --pitch -10\n"
    "  ods convert picture.exr -o closer.exr --ipd 0.055 --merge cosine,60,90";

constexpr const char* kSummary =
    "Converts a stereo 360 picture to another projection, layout, size or convergence, or extracts single eyes. "
    "Pictures\n"
    "with depth (.exr of ods render) can also get another eye distance or pole merge. Everything that is not given "
    "stays\n"
    "as it is.";

// What the command line asks for.
struct Wishes {
  ods::RenderOptions size;  // width, height and eyes of the output
  std::optional<Layout> layout;
  CameraOptions camera;  // the input's, with the options applied
  bool mono = false;
};

// Opens the input as soon as --from-* options are known; the options after it change what its header says.
void open_header(const std::string& path, ConvertJob& job, Wishes& wishes) {
  job.input = path;
  ods::OpenOptions open;
  open.format = job.known;
  job.picture = job.reader.emplace(path, open).header();
  wishes.camera.stereo = job.picture.camera;
}

void add_input_options(Options& options, ConvertJob& job, Wishes& wishes) {
  options.group("Input, if neither the file nor its name tells");
  options.custom(
      "--from-projection", "NAME", "",
      [&](const std::string& name) { job.known.projection = projection_by_name("--from-projection", name); },
      "its projection");
  add_layout_option(options, job.known.layout, "its layout; separate: one eye", "--from-layout");
  options.custom(
      "--from-camera", "FILE", "",
      [&](const std::string& path) {
        std::vector<std::string> warnings;
        const ods::Sidecar file = ods::open_camera(path, warnings);
        job.known.camera = file.camera;
        if (!job.known.layout) job.known.layout = file.eyes.size() == 2 ? file.layout : Layout::kSeparate;
        for (const std::string& warning : warnings) note(warning);
      },
      "its camera: a .camera.json file or a picture that carries it");
  options.argument(
      "IN", [&](const std::string& path) { open_header(path, job, wishes); },
      "input file: .png .jpg .tif .webp .hdr .exr; %V in the name reads one file per eye");
}

void add_output_options(Options& options, ConvertJob& job, Wishes& wishes, Layout& layout_of_size) {
  options.group("Output");
  options.text("-o,--output", "FILE", job.output,
               "output file: .png .jpg .tif .webp .hdr .exr; %V in the name writes one file per eye");
  add_size_option(options, wishes.size, layout_of_size);
  options.number("--width", wishes.size.width, 0, 32768, "width of one eye in pixels; 0: keeps the input's resolution");
  options.number("--height", wishes.size.height, 0, 32768,
                 "height of one eye in pixels; 0: follows from the width and projection");
  options.choice("--eyes", wishes.size.eyes, ods::kEyesTable, "which eyes to make");
  options.flag("--mono", wishes.mono, "make a mono picture of one eye: the left one, or that of --eyes");
  add_layout_option(options, wishes.layout,
                    "how both eyes share the file; by default the input's, side-by-side for --to vr180");
  options.flag("--sidecar", job.save.sidecar,
               "also write the camera to picture.camera.json, which --from of other commands reads");
  options.number("--exposure", job.save.exposure, -30.0f, 30.0f,
                 "exposure in stops; .hdr and .exr stay scene-linear and ignore it");
  options.choice("--tone", job.save.tone, ods::kToneCurveTable,
                 "tone curve, when converting .hdr or .exr to another format");
}

void add_camera(Options& options, CameraOptions& camera) {
  add_projection_options(options, camera.stereo.projection, "--to");
  options.group("Turn");
  add_field_option(options, "--yaw", camera.yaw, CameraField::kYaw, "turn to the right, degrees");
  add_field_option(options, "--pitch", camera.pitch, CameraField::kPitch, "tilt up, degrees; mono pictures only");
  add_field_option(options, "--roll", camera.roll, CameraField::kRoll, "roll clockwise, degrees; mono pictures only");
  add_circle_options(options, camera);
}

// A mono picture is one of the existing eyes, wherever the eyes are to move.
void note_unmoved(const ConvertJob& job, StereoCamera wished) {
  const StereoCamera& own = job.picture.camera;
  wished.yaw = own.yaw, wished.pitch = own.pitch, wished.roll = own.roll;
  if (job.target.eyes[0] == ods::kMono && !ods::same_eyes(wished, own))
    note("--ipd, --merge, --head-tilt-map and --eye-to-neck change nothing of one eye");
}

std::vector<int> wished_eyes(const ConvertJob& job, const Wishes& wishes, bool given) {
  if (wishes.mono || wishes.size.eyes == Eyes::kMonoEye) return {ods::kMono};
  if (given) return ods::eye_list(wishes.size.eyes);
  return same_format(job.picture).eyes;
}

void set_target(const Options& options, Wishes& wishes, ConvertJob& job) {
  finish_eye_options(wishes.camera);
  StereoCamera& stereo = job.target.camera = wishes.camera.stereo;
  const CameraOptions& by = wishes.camera;
  turn(stereo, by.yaw.value_or(0.0f), by.pitch.value_or(0.0f), by.roll.value_or(0.0f));
  job.target.eyes = wished_eyes(job, wishes, options.given("--eyes") || options.given("--size"));
  note_unmoved(job, stereo);
  if (wishes.size.eyes == Eyes::kRightEye) job.target.mono_from = ods::kRight;
  save_as_it_was(job.picture, stereo.projection, job.output, wishes.layout, options.given("--tone"), job.save);
  if (options.given("--exposure") && keeps_light(job.output))
    note("--exposure leaves .exr and .hdr as the scene is lit");

  ods::Extent& eye = job.target.eye = ods::fitting_extent(job.picture, stereo.projection);
  if (wishes.size.width > 0) eye = {wishes.size.width, wishes.size.height};
  finish_projection(stereo.projection, eye.width, eye.height);
  note_misleading_name(job.output, job.save, job.target.eyes.size(), stereo.projection);
}

// Asked of the header, so that nobody waits for pixels in vain, and of the pixels: reading them may leave out a layer
// of depth that the header promised.
void refuse_impossible(const ConvertJob& job) {
  const std::string fault = ods::conversion_fault(job.picture, job.target);
  if (!fault.empty()) throw UsageError(fmt::format("'{}': {}", job.input, fault));
}

}  // namespace

bool read_convert_job(ConvertJob& job, int argc, char** argv) {
  Options options("convert", kSummary, kExamples);
  Wishes wishes;
  wishes.size.width = 0;
  Layout layout_of_size = Layout::kTopBottom;
  add_input_options(options, job, wishes);
  add_output_options(options, job, wishes, layout_of_size);
  add_camera(options, wishes.camera);
  options.group("Console");
  options.number("--threads", job.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, job.progress);
  if (!options.parse(argc, argv)) return false;
  if (job.output.empty()) throw UsageError("no output file: add -o picture.png");
  if (options.given("--width") && !options.given("--height")) wishes.size.height = 0;
  if (options.given("--height") && wishes.size.width == 0) throw UsageError("--height goes with --width");
  if (options.given("--size") && !wishes.layout) wishes.layout = layout_of_size;
  refuse_overwriting(job.output, job.input);
  set_target(options, wishes, job);
  ods::check_output(job.output, job.save, job.target.eyes, job.target.eye, &job.target.camera.projection);
  refuse_impossible(job);
  return true;
}

void open_input(ConvertJob& job) {
  job.picture = job.reader->read(ods::existing_folder_of(job.output));
  job.reader.reset();  // it may hold a decoder's memory
  note_guesses(job.input, job.picture);
  refuse_impossible(job);
}
