// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/convert_job.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/convert/right_eye_options.h"
#include "cli/options/eye_options.h"
#include "cli/options/field_option.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"
#include "cli/options/time_options.h"
#include "ods/files/atomic_file.h"
#include "ods/picture/metadata/sidecar.h"

using ods::CameraField, ods::StereoCamera, ods::Eyes, ods::Layout, ods::FootageKind;

namespace {

constexpr const char* kConvertExamples =
    "  ods convert picture.png -o cubes.png --to cube-3x2\n"
    "  ods convert picture_TB.jpg -o headset.jpg --to vr180 --width 4096\n"
    "  ods convert picture.exr -o window.png --mono --to perspective --fov 70 --yaw 30 --pitch -10\n"
    "  ods convert picture.exr -o closer.exr --ipd 0.055 --merge cosine,60,90\n"
    "  ods convert panorama.jpg --depth depth.npy --depth-kind inverse --near 0.7 --far 30 -o stereo_360_TB.png\n"
    "  ods convert video_360_TB.mp4 -o headset_180_LR.mp4 --to vr180 --trim 0:10-0:20\n"
    "  ods convert 'shot_360_TB.####.png' -o 'cubes.####.png' --to cube-3x2";

constexpr const char* kConvertSummary =
    "Converts a stereo 360 picture, frames or a video to another projection, layout, size or convergence, or to\n"
    "single eyes. Pictures with depth (.exr of ods render, or --depth) can also get another eye distance or pole "
    "merge,\n"
    "or two eyes from one. What is not given stays as it is; a video keeps its codec, times, sound, colours and "
    "metadata.";

// What the command line asks for.
struct Wishes {
  ods::RenderOptions size;  // width, height and eyes of the output
  std::optional<Layout> layout;
  CameraOptions camera;  // the input's, with the options applied
  bool mono = false;
  std::optional<std::vector<int>> frames;
};

// Opens the input as soon as the options that say what it is are known; the options after it change what its header
// says.
void open_header(const std::string& path, ConvertJob& job, Wishes& wishes) {
  job.input = path;
  finish_lens_options(job.known);
  job.kind = ods::footage_kind(path);
  if (job.kind == FootageKind::kFrames) job.files = ods::find_frames(path, wishes.frames);
  ods::OpenOptions open;
  open.format = identified_input(path, job.known);
  switch (job.kind) {
    case FootageKind::kPicture:
      job.picture = job.reader.emplace(path, open).header();
      break;
    case FootageKind::kFrames:
      job.picture = ods::PictureReader(job.files.path(0), open).header();
      break;
    case FootageKind::kVideo:
      job.picture = job.footage.emplace(path, open.format).video().prototype;
      break;
  }
  wishes.camera.stereo = job.picture.camera;
  if (job.depth.path.empty()) return;
  ods::promise_depth(job.picture);
  const bool is_mono = job.picture.eyes.size() == 1, has_merge = job.picture.has_ipd;
  if (is_mono && !has_merge) wishes.camera.stereo.top = wishes.camera.stereo.bottom = ods::kUsualMerge;
}

// "0:10-0:20", "10-", "-20.5".
ods::TimeSpan parse_span(const std::string& text) {
  const size_t dash = text.find('-');
  const std::string from = text.substr(0, dash), to = dash == std::string::npos ? "" : text.substr(dash + 1);
  const std::optional<double> start = from.empty() ? 0.0 : ods::parse_time(from);
  std::optional<double> end;
  if (!to.empty()) end = ods::parse_time(to);
  if (dash == std::string::npos || !start || (!to.empty() && !end) || (end && *end <= *start)) {
    throw UsageError(fmt::format("--trim is a span of time such as 0:10-0:20, 10- or -20.5, not '{}'", text));
  }
  return {*start, end};
}

void add_input_options(Options& options, ConvertJob& job, Wishes& wishes) {
  add_depth_options(options, job.depth);  // first: the header that opens has depth
  options.group("Input, if it is not detected");
  options.custom(
      "--projection", "NAME", "",
      [&](const std::string& name) { job.known.projection = projection_by_name("--projection", name); },
      "its projection");
  add_input_layout_option(options, job.known.layout, "its layout");
  add_lens_options(options, job.known);
  options.custom(
      "--camera", ValueKind::input_file(), "",
      [&](const std::string& path) {
        std::vector<std::string> warnings;
        const ods::Sidecar file = ods::open_camera(path, warnings);
        job.known.camera = file.camera;
        if (!job.known.layout) job.known.layout = file.eyes.size() == 2 ? file.layout : Layout::kSeparate;
        for (const std::string& warning : warnings) note(warning);
      },
      "its camera: a .camera.json file or a picture that carries it");
  options.custom(
      "--frames", "RANGE", "", [&](const std::string& text) { wishes.frames = ods::parse_frames(text); },
      "frames to convert, if the input is frames: 1-100, 1-100x2 or 1,5,10-20; by default all");
  options.argument(
      ValueKind::input_file("IN"), [&](const std::string& path) { open_header(path, job, wishes); },
      "a picture (.png .jpg .tif .webp .hdr .exr .heic .avif), frames (#### in the name is the number) or a video "
      "(.mp4 .mov .mkv "
      ".webm); %V in the name: one file per eye");
}

void add_output_options(Options& options, ConvertJob& job, Wishes& wishes, Layout& layout_of_size) {
  options.group("Output");
  options.text("-o,--output", ValueKind::output_file(), job.output,
               "output file: .png .jpg .tif .webp .hdr .exr; #### in the name writes frames, .mp4 .mov .mkv .webm a "
               "video, %V one file per eye");
  add_share_options(options, job.share);
  add_size_option(options, wishes.size, layout_of_size);
  options.number("--width", wishes.size.width, 0, 32768, "width of one eye in pixels; 0: keeps the input's resolution");
  options.number("--height", wishes.size.height, 0, 32768,
                 "height of one eye in pixels; 0: follows from the width and projection");
  options.choice("--eyes", wishes.size.eyes, ods::kEyesTable, "which eyes to make");
  options.flag("--mono", wishes.mono, "make a mono picture of one eye: the left one, or that of --eyes");
  add_layout_option(options, wishes.layout,
                    "how both eyes share the new file; by default as its name says (_TB, _LR), else the input's, "
                    "side-by-side for --to vr180",
                    "--to-layout");
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
  camera.may_follow_depth = true;
  add_circle_options(options, camera);
}

void add_video(Options& options, ConvertJob& job) {
  options.group("Video (by default encoded like the input)");
  options.custom(
      "--trim", "FROM-TO", "", [&](const std::string& text) { job.trim = parse_span(text); },
      "convert only this part of a video: 0:10-0:20, 10-, -20.5 (seconds, minutes, hours)");
  options.custom(
      "--stabilize", ValueKind::input_file(), "",
      [&](const std::string& path) { job.turns = ods::read_turn_keys(path); },
      "how the camera was turned, to turn its video back: lines of TIME ROLL or TIME YAW PITCH ROLL");
  options.custom(
      "--fps", "X|N/M", "30", [&](const std::string& text) { job.video.rate = parse_rate(text); },
      "frames per second, if the input is frames");
  add_packing_options(options, job.video);
  add_restart_option(options, job.restart);
}

// A mono picture is one of the existing eyes, wherever the eyes are to move.
void note_unmoved(const ConvertJob& job, StereoCamera wished) {
  const StereoCamera& own = job.picture.camera;
  wished.yaw = own.yaw, wished.pitch = own.pitch, wished.roll = own.roll;
  if (job.target.eyes[0] == ods::kMono && !ods::same_eyes(wished, own))
    note("--ipd, --merge, --head-tilt-map and --eye-to-neck have no effect on one eye");
}

// Some merge, by which it is judged before the depth is there whether the conversion is possible.
void promise_merge(StereoCamera& camera) {
  auto half = std::make_shared<ods::Image>(1, 1, 1);
  half->pixels[0] = 0.5f;
  camera.merge_map = half;
  camera.top.mode = camera.bottom.mode = ods::kMergeMap;
}

std::vector<int> wished_eyes(const ConvertJob& job, const Wishes& wishes, bool given) {
  if (wishes.mono || wishes.size.eyes == Eyes::kMonoEye) return {ods::kMono};
  if (given) return ods::eye_list(wishes.size.eyes);
  const bool makes_two = !job.depth.path.empty() && job.picture.eyes.size() == 1;
  return makes_two ? std::vector<int>{ods::kLeft, ods::kRight} : same_format(job.picture).eyes;
}

void set_target(const Options& options, Wishes& wishes, ConvertJob& job) {
  finish_eye_options(wishes.camera);
  StereoCamera& stereo = job.target.camera = wishes.camera.stereo;
  job.merge_limit = wishes.camera.merge_limit;
  if (job.merge_limit) promise_merge(stereo);
  const CameraOptions& by = wishes.camera;
  turn(stereo, by.yaw.value_or(0.0f), by.pitch.value_or(0.0f), by.roll.value_or(0.0f));
  job.target.eyes = wished_eyes(job, wishes, options.given("--eyes") || options.given("--size"));
  note_unmoved(job, stereo);
  if (wishes.size.eyes == Eyes::kRightEye) job.target.mono_from = ods::kRight;
  job.has_exposure = options.given("--exposure"), job.has_tone = options.given("--tone");
  job.has_layout = wishes.layout.has_value();
  save_as_it_was(job.picture, stereo.projection, job.output, wishes.layout, job.has_tone, job.save);
  if (job.has_exposure && keeps_light(job.output)) note("--exposure does not affect .exr and .hdr");

  ods::Extent& eye = job.target.eye = ods::fitting_extent(job.picture, stereo.projection);
  if (wishes.size.width > 0) eye = {wishes.size.width, wishes.size.height};
  finish_projection(stereo.projection, eye.width, eye.height);
  if (ods::container_of_path(job.output)) return;  // say_what_players_need() does
  note_misleading_name(job.output, job.save, job.target.eyes.size(), stereo.projection);
}

// The way from what there is to what is asked for: a picture gives a picture, frames and videos give both.
void check_kinds(const Options& options, const ConvertJob& job) {
  const bool to_video = ods::container_of_path(job.output).has_value();
  const bool to_frames = ods::frame_names(job.output).has_value();
  if (job.kind == FootageKind::kPicture && (to_video || to_frames)) {
    throw UsageError(
        fmt::format("'{}' is one picture; a video and frames are made of frames (shot.####.png) or of a "
                    "video",
                    job.input));
  }
  if (job.kind != FootageKind::kPicture && !to_video && !to_frames) {
    throw UsageError(
        fmt::format("'{}' has many pictures, '{}' would be one: name frames (-o 'shot.####.png') or a "
                    "video (.mp4 .mov .mkv .webm)",
                    job.input, job.output));
  }
  const bool from_video = job.kind == FootageKind::kVideo;
  for (const char* name : {"--trim", "--stabilize"}) {
    if (options.given(name) && !from_video) throw UsageError(fmt::format("{} is for videos", name));
  }
  if (options.given("--frames") && job.kind != FootageKind::kFrames) {
    throw UsageError("--frames is for frames; --trim chooses a part of a video");
  }
  if (options.given("--fps") && from_video) throw UsageError("--fps is for frames: a video keeps its own times");
  if (job.restart && !to_video) throw UsageError("--restart is for videos; frames continue with --skip-existing");
  if (job.has_packing && !to_video)
    throw UsageError(fmt::format("--codec and similar options need video output, and '{}' is not a video", job.output));
}

}  // namespace

void refuse_impossible(const ConvertJob& job, const ods::StoredPicture& picture) {
  const std::string fault = ods::conversion_fault(picture, job.target);
  if (!fault.empty()) throw UsageError(fmt::format("'{}': {}", job.input, fault));
}

bool read_convert_job(ConvertJob& job, int argc, char** argv) {
  job.arguments.assign(argv, argv + argc);
  Options options("convert", kConvertSummary, kConvertExamples);
  Wishes wishes;
  wishes.size.width = 0;
  job.target.holes = ods::Holes::kFilled;
  Layout layout_of_size = Layout::kTopBottom;
  add_input_options(options, job, wishes);
  add_output_options(options, job, wishes, layout_of_size);
  add_camera(options, wishes.camera);
  options.choice("--holes", job.target.holes, ods::kHolesTable,
                 "where eyes that are moved see what none of the picture does: filled from what is behind, or empty");
  add_video(options, job);
  add_right_eye_options(options, job.target.right);
  options.group("Console");
  options.number("--threads", job.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, job.progress);
  if (!options.parse(argc, argv)) return false;
  if (job.output.empty()) throw UsageError("no output file: add -o picture.png");
  if (options.given("--width") && !options.given("--height")) wishes.size.height = 0;
  if (options.given("--height") && wishes.size.width == 0) throw UsageError("--height goes with --width");
  if (options.given("--size") && !wishes.layout) wishes.layout = layout_of_size;
  job.has_target = options.given("--target");
  for (const char* name : {"--target", "--codec", "--encoder", "--preset", "--crf", "--bitrate", "--bits", "--chroma",
                           "--audio", "--apple"}) {
    job.has_packing = job.has_packing || options.given(name);
  }
  check_kinds(options, job);
  check_depth_options(options, job.depth);
  check_share(job.share, job.input, job.output);
  job.every_frame = job.files.frames;
  job.files.frames = own_frames(job.share.only, job.files.frames);  // the first frame of all says what they are
  refuse_overwriting(job.output, job.input);
  set_target(options, wishes, job);
  refuse_impossible(job, job.picture);
  if (ods::container_of_path(job.output)) return true;  // convert_to_video() judges the output
  ods::check_output(job.output, job.save, job.target.eyes, job.target.eye, &job.target.camera.projection);
  return true;
}

void open_input(ConvertJob& job) {
  job.picture = job.reader->read(ods::existing_folder_of(job.output));
  job.reader.reset();  // it may hold a decoder's memory
  note_guesses(job.input, job.picture);
  if (!job.depth.path.empty()) give_depth(job.depth, job.picture);
  refuse_impossible(job, job.picture);
  StereoCamera& camera = job.target.camera;
  if (job.merge_limit && job.target.eyes[0] != ods::kMono) {
    use_shares(ods::comfortable_shares(ods::seen_by_eyes(job.picture), camera, *job.merge_limit), camera);
  }
}

std::optional<int> first_of_all(const ConvertJob& job) {
  if (job.kind != FootageKind::kFrames || job.every_frame.empty()) return std::nullopt;
  return job.every_frame.front();
}

void open_depth(ConvertJob& job) {
  if (job.depth.path.empty()) return;
  const bool is_part = job.files.frames != job.every_frame || job.share.skip_existing;
  if (is_part && ods::footage_kind(job.depth.path) == FootageKind::kVideo) {
    throw UsageError(fmt::format(
        "--only and --skip-existing need the depth as frames (depth.####.png), which have numbers: '{}' is a video",
        job.depth.path));
  }
  job.depth_frames.emplace(job.depth.path, job.picture, job.depth.options, job.trim, first_of_all(job));
}
