// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_with_cycles.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/cycles/cycles_part.h"
#include "cli/cycles/cycles_picture.h"
#include "cli/cycles/surround.h"
#include "cli/options/disk_room.h"
#include "cli/options/picture_options.h"
#include "cli/options/waiting.h"
#include "cli/render/first_look.h"
#include "cli/render/plan.h"
#include "cli/render/render_frames.h"
#include "ods/camera/camera_move.h"
#include "ods/files/private_folder.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/render/part_file.h"
#include "ods/scene/scene.h"
#include "ods/sequence/identity.h"
#include "ods/sequence/shared_frames.h"
#include "ods/sequence/video_journal.h"
#include "ods/stage/light/supply.h"

namespace {

bool is_given(const RenderJob& job, const char* option) {
  return std::ranges::find(job.given, option, &GivenWord::name) != job.given.end();
}

// The frame of the file at a time of the job.
double file_frame(const RenderJob& job, double seconds) {
  const CyclesScene& scene = job.cycles->scene();
  if (scene.foreign.frames.count == 0 && !makes_video(job.time) && !job.time.time) return scene.now;
  return scene.foreign.frames.first + seconds * scene.fps;
}

CyclesPicture picture_of(const RenderJob& job) {
  const RenderPlan planned = plan(job);
  CyclesPicture picture;
  picture.camera = job.camera.stereo;
  picture.camera.pitch = job.camera.pitch.value_or(0.0f);
  picture.camera.roll = job.camera.roll.value_or(0.0f);
  picture.eye = {job.render.width, job.render.height};
  picture.eyes = ods::eye_list(job.render.eyes);
  picture.denoiser = planned.sequence.finish.denoiser;
  picture.layers = job.render.layers;
  picture.has_alpha = job.render.transparent || job.cycles->scene().transparent;
  picture.save = job.save;
  picture.save.exposure = unmeasured_exposure(job);
  picture.save.attributes.push_back({"ods:renderer", "Cycles of Blender " + job.cycles->scene().blender});
  CyclesShot& shot = picture.shot;
  shot.position = job.camera.position;
  shot.yaw = job.camera.yaw;
  shot.device = is_given(job, "--device") ? job.device : "";
  shot.samples = job.render.samples;
  shot.noise = job.quality.noise;
  shot.time_limit = job.render.time_limit / static_cast<double>(picture.eyes.size());
  if (is_given(job, "--bounces")) shot.bounces = job.render.bounces;
  shot.shutter = job.time.given_shutter;
  shot.transparent = job.render.transparent;
  shot.threads = job.render.threads;
  picture.statistics = job.render.statistics;
  if (job.part) picture.part = *job.part;
  check_cycles_picture(picture);
  return picture;
}

void report_start(const RenderJob& job, const CyclesPicture& picture, size_t frames) {
  const CyclesScene& scene = job.cycles->scene();
  note(fmt::format("Cycles of Blender {} renders {}, {}x{} per eye, at most {} samples per pixel", scene.blender,
                   job.part      ? fmt::format("part {} of a picture", ods::part_text(*job.part))
                   : frames == 1 ? "a picture"
                                 : fmt::format("{} frames", frames),
                   picture.eye.width, picture.eye.height, picture.shot.samples / picture.part.count));
  if (job.camera.stereo.lens_radius > 0.0f) note("the lens blurs as Cycles' does, which differs towards the poles");
  if (picture.denoiser == ods::Denoiser::kNone && !keeps_light(job.output) && !job.denoise && !job.part) {
    note("not denoised: one sample does not show its noise");
  }
}

// Cycles' own figures, with --statistics.
void report_statistics(const RenderJob& job, double seconds, size_t frames) {
  if (!job.render.statistics) return;
  note(fmt::format(
      "Cycles took {} for {}, at most {} samples per pixel, at most {:.4g} MB for the scene and its picture",
      duration_text(seconds), frames == 1 ? "the picture" : fmt::format("{} frames", frames), job.render.samples,
      job.cycles->peak_memory()));
}

// Moves the camera of a shot, and with motion blur its places before and after.
void move_camera(const RenderJob& job, const ods::CameraMove& move, double seconds, CyclesShot& shot) {
  if (!ods::moves(move)) return;
  const double frame = 1.0 / job.cycles->scene().fps;
  const auto place = [&](double frames) {
    CyclesShot there = shot;
    there.frame += frames;
    const CyclesPose own = job.cycles->pose(there);
    ods::StereoCamera camera;
    camera.position = own.position, camera.yaw = own.yaw;
    camera = ods::moved(camera, move, seconds + frames * frame);
    return CyclesPose{camera.position, camera.yaw};
  };
  const CyclesPose now = place(0.0);
  if (job.time.shutter > 0.0f) shot.before = place(-1.0), shot.after = place(1.0);
  shot.position = now.position, shot.yaw = now.yaw;
}

// The first lines about a frame that is made.
class FirstFrame {
 public:
  explicit FirstFrame(const RenderJob& job) : job_(job) {}

  void say(const CyclesSaved& saved) {
    if (std::exchange(said_, true)) return;
    const std::string camera = job_.cycles->scene().camera;
    const ods::vec3 at = saved.pose.position;
    const bool is_given = job_.camera.position.has_value();
    if (is_given ? ::is_given(job_, "--position") : !camera.empty()) {  // our own choice has been noted
      note(fmt::format("camera at {:.4g},{:.4g},{:.4g}, yaw {:.4g} ({})", at.x, at.y, at.z, saved.pose.yaw,
                       is_given ? "--position" : "the scene's camera '" + camera + "'"));
    }
    const std::string device = job_.cycles->device();
    if (!device.empty()) note("Cycles renders on " + device);
    if (!saved.strain.empty()) warn(saved.strain + ", or a smaller --ipd; ods comfort has more");
  }

 private:
  const RenderJob& job_;
  bool said_ = false;
};

std::vector<ods::SequenceFrame> all_frames(const RenderJob& job, const TimeOptions& time) {
  if (!makes_video(time)) return {{0, double{time.time.value_or(0.0f)}, job.output, job.render.seed}};
  video_names(job.output);  // throws
  return ods::make_frames(plan(job, time).sequence, video_frames(time), job.output);
}

// Renders a part of the samples, and saves it for ods merge.
std::string save_part(const RenderJob& job, const CyclesPicture& picture, const ods::FrameNames& parts,
                      const std::function<void(double)>& report) {
  const ods::RenderOptions options = options_of_parts(job.render);
  const CyclesPart part = make_part(*job.cycles, picture, options, parts, report);
  ods::StereoCamera camera = picture.camera;
  camera.position = part.pose.position, camera.yaw = part.pose.yaw;
  const ods::Sidecar sidecar{camera, picture.eye, picture.save.layout, picture.eyes};
  const ods::SaveOptions& save = picture.save;
  return ods::save_part(
      job.output, {cycles_part_identity(job), write_sidecar(sidecar), save.exposure, save.tone, options}, part.samples);
}

// One picture, or a part of it: its files are kept beside it until it is complete.
std::vector<std::string> render_picture(const RenderJob& job, const ods::SequenceFrame& frame,
                                        const ods::CameraMove& move, const std::function<void(double)>& report) {
  CyclesPicture picture = picture_of(job);
  picture.shot.frame = file_frame(job, frame.time);
  picture.shot.seed = frame.seed;
  move_camera(job, move, frame.time, picture.shot);
  ods::VideoJournal journal(job.output, job.part ? cycles_part_identity(job) : cycles_identity(job), job.restart);
  const std::vector<int> numbers = part_numbers(picture);
  journal.plan(numbers, numbers);
  const ods::FrameNames parts = *ods::frame_names(journal.pattern());
  const auto is_there = [&](int number) { return ods::is_saved(parts.path(number)); };
  const auto there = std::ranges::count_if(numbers, is_there);
  if (there > 0) note(fmt::format("resuming: {} of {} parts exist already", there, numbers.size()));
  report_start(job, picture, 1);
  const auto check_and_report = [&](double done) {
    journal.check();
    report(done);
  };
  if (job.part) {
    const std::string file = save_part(job, picture, parts, check_and_report);
    journal.remove();
    return {file};
  }
  const CyclesSaved saved = make_picture(*job.cycles, picture, parts, job.output, check_and_report);
  journal.remove();
  FirstFrame(job).say(saved);
  return saved.files;
}

// The light that --env and --background give, read before Blender starts.
struct GivenLight {
  ods::LightChoices choices;
  std::optional<ods::Environment> background;
};

GivenLight read_light(const RenderJob& job) {
  const LightOptions& light = job.scene.light;
  if (light.environment.empty() && (light.turn != 0.0f || light.strength != 1.0f)) {
    throw UsageError(
        "--env-turn and --env-strength need --env with --renderer cycles: the file's own world is changed in Blender");
  }
  return {read_choices(light, job.render.transparent, ""), read_background(light.background, "")};
}

// Puts the light around the scene that Blender has opened. The studio stands before the camera.
void surround_scene(const RenderJob& job, GivenLight given) {
  const LightOptions& light = job.scene.light;
  const bool has_light = !light.environment.empty();
  if (given.choices.surround == ods::Surround::kStudio) {
    CyclesShot here;
    here.frame = job.cycles->scene().now;
    here.position = job.camera.position, here.yaw = job.camera.yaw;
    given.choices.yaw = job.cycles->pose(here).yaw;
  }
  ods::Scene around;
  ods::LightPlan plan;
  plan.sky = given.choices.sky;
  if (has_light) plan.surround = given.choices.surround;
  ods::apply_light(around, {}, plan, given.choices);
  if (!light.background.empty()) around.background = given.background;
  if (plan.surround == ods::Surround::kStudio || plan.surround == ods::Surround::kSky) {
    note("no ground is added under objects: only --renderer ods does that");
  }
  const std::string lit = has_light ? job.cycles->path("light.exr") : "";
  const std::string behind = around.background ? job.cycles->path("background.exr") : "";
  if (has_light) write_surround(around.environment, lit);
  if (around.background) write_surround(*around.background, behind);
  job.cycles->surround(lit, behind);
}

// Has the scene converted and measured as for our renderer, and finds what depends on it: the viewer's place in a file
// without a camera, and the middle of an object for --turntable.
void measure_scene(RenderJob& job) {
  ods::CameraMove& move = job.time.move;
  const bool needs_place = job.cycles->scene().camera.empty() && !job.camera.position && job.camera.file.empty();
  const bool needs_middle = move.turns != 0.0 && !move.pivot && move.fly_to.empty();
  if (!needs_place && !needs_middle) return;
  SceneSource source = job.scene;
  read_foreign(source);
  source.foreign->warnings.clear();  // Cycles loses nothing
  const ods::Scene scene = open_scene(source);
  if (needs_place) {
    const ods::StereoCamera placed = place_camera(job.camera, scene);
    job.camera.position = placed.position, job.camera.yaw = placed.yaw;
  }
  if (!needs_middle || !scene.viewing || !scene.viewing->is_object) return;
  move.pivot = scene.viewing->middle;
  move.turns = -move.turns;  // an object that turns clockwise is seen as from a viewer who circles counter-clockwise
  note("the viewer moves around the object: with --renderer cycles it does not turn, and its light stays on it");
}

}  // namespace

void open_in_cycles(RenderJob& job) {
  check_cycles_scene(job.scene.name);
  if (job.camera.changes.merge_limit) {
    throw UsageError(
        "--merge auto cannot be used with --renderer cycles: ods convert --merge auto changes an .exr that is finished");
  }
  const BlenderOptions blender = blender_options(job.scene);
  if (find_blender(blender).empty()) {
    throw ods::Error(ods::ErrorKind::kInput,
                     "--renderer cycles needs Blender: install it, or name it with --blender PATH");
  }
  const GivenLight light = read_light(job);
  job.cycles = std::make_shared<CyclesSession>(blender, job.scene.name, job.camera.view_point);
  const CyclesScene& scene = job.cycles->scene();
  for (const std::string& warning : scene.foreign.warnings) warn(warning);
  measure_scene(job);
  job.scene.foreign = scene.foreign;
  surround_scene(job, light);
  job.render.samples = job.quality.samples.value_or(std::max(1, scene.samples));
  job.render.noise = job.quality.noise.value_or(0.0f);
  job.exposure = job.exposure.value_or(scene.exposure);
  const bool is_plain = scene.view == "Standard" || scene.view == "Raw";
  if (!job.tone) job.tone = is_plain ? ods::ToneCurve::kLinear : ods::ToneCurve::kNeutral;
}

TimeOptions cycles_time(const RenderJob& job) {
  TimeOptions time = job.time;
  if (!time.grain) time.grain = ods::moves(time.move) ? Grain::kChanging : Grain::kFixed;
  ods::Scene nothing;
  start_clock(time, job.camera, nothing);
  if (time.is_video && time.file.count == 0 && time.frames.empty() && !time.duration && !ods::moves(time.move)) {
    throw UsageError("nothing moves in the file: add --duration SECONDS, --frames LIST or --turntable 1");
  }
  return time;
}

// The settings of Cycles, before the rest.
static ods::Settings with_cycles(const RenderJob& job, const ods::Settings& rest) {
  ods::Settings settings = {{"`renderer`", "cycles", ""}, {"Blender", job.cycles->scene().blender, ""}};
  settings.insert(settings.end(), rest.begin(), rest.end());
  return settings;
}

ods::Settings cycles_part_identity(const RenderJob& job) {
  return with_cycles(job, sample_identity(identified(job), double{job.time.time.value_or(0.0f)}));
}

ods::Settings cycles_identity(const RenderJob& job) {
  ods::SequenceOptions sequence = identified(job);
  sequence.exposure = sequence.brighter = 0.0f;  // Cycles judges noise without them
  ods::Settings settings = with_cycles(job, frame_identity(sequence));
  if (job.time.time) settings.push_back({"`time`", fmt::format("{}", *job.time.time), ""});
  return settings;
}

void render_cycles_frames(const RenderJob& job, const CyclesFrames& frames) {
  const CyclesPicture usual = picture_of(job);
  if (!frames.missing.empty()) report_start(job, usual, frames.missing.size());
  FirstFrame first(job);
  const auto make = [&](size_t i) {
    const ods::SequenceFrame& frame = frames.all[frames.missing[i]];
    CyclesPicture picture = usual;
    picture.shot.frame = file_frame(job, frame.time);
    picture.shot.seed = frame.seed;
    move_camera(job, frames.move, frame.time, picture.shot);
    const ods::PrivateFolder folder;
    const ods::FrameNames parts = *ods::frame_names(folder.path() + "/part.####.exr");
    const ods::FrameAtWork at{static_cast<int>(i) + 1, static_cast<int>(frames.missing.size()), frame.path};
    const CyclesSaved saved = make_picture(*job.cycles, picture, parts, frame.path, [&](double done) {
      frames.report((static_cast<double>(i) + done) / static_cast<double>(frames.missing.size()), at);
    });
    first.say(saved);
    frames.saved(saved.files);
  };
  if (frames.shared) {
    std::vector<ods::SharedFrame> files;
    for (const size_t index : frames.missing) files.push_back({frames.all[index].number, frames.all[index].path});
    ods::make_shared_frames(files, make, note_waiting("frame"));
  } else {
    for (size_t i = 0; i < frames.missing.size(); i++) make(i);
  }
}

void render_with_cycles(const RenderJob& job, ProgressLines& lines) {
  check_outputs(job);
  const TimeOptions time = cycles_time(job);
  const std::vector<ods::SequenceFrame> all = all_frames(job, time);
  std::vector<int> numbers;
  for (const ods::SequenceFrame& frame : all) numbers.push_back(frame.number);
  const std::vector<int> chosen = own_frames(time.only, numbers);
  CyclesFrames frames{all, ods::choose_frames(all, chosen, time.skip_existing), time.skip_existing, time.move, {}, {}};
  const bool is_video = makes_video(time);
  if (is_video) note_existing_frames(chosen.size() - frames.missing.size(), chosen.size());
  if (!is_video && frames.missing.empty()) return note(fmt::format("'{}' exists already", all.front().path));
  if (is_video) note_disk_space(job.output, frames.missing.size(), largest_frame(job.output, job.render, job.save));
  const auto start = std::chrono::steady_clock::now();
  frames.report = [&](double done, const ods::FrameAtWork& at) {
    lines.report(done, seconds_since(start), {"render", at.place, is_video ? at.count : 0, at.path});
  };
  frames.saved = [&](const std::vector<std::string>& files) {
    lines.clear();
    for (const std::string& file : files) announce_file(file);
  };
  if (is_video) {
    render_cycles_frames(job, frames);
  } else {
    frames.saved(render_picture(job, all.front(), time.move, [&](double done) {
      frames.report(done, {1, 1, job.output});
    }));
  }
  note(fmt::format("rendered in {}", duration_text(seconds_since(start))));
  report_statistics(job, seconds_since(start), frames.missing.size());
}
