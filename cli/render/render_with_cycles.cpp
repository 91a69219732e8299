// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_with_cycles.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/cycles/cycles_picture.h"
#include "cli/cycles/surround.h"
#include "cli/options/disk_room.h"
#include "cli/options/picture_options.h"
#include "cli/options/waiting.h"
#include "cli/render/plan.h"
#include "cli/render/render_frames.h"
#include "ods/files/private_folder.h"
#include "ods/scene/scene.h"
#include "ods/sequence/identity.h"
#include "ods/sequence/shared_frames.h"
#include "ods/sequence/video_journal.h"
#include "ods/stage/exposure.h"
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
  picture.save.exposure = ods::brightened(job.exposure.value_or(0.0f), job.brighter);
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
  return picture;
}

void report_start(const RenderJob& job, const CyclesPicture& picture, size_t frames) {
  const CyclesScene& scene = job.cycles->scene();
  note(fmt::format("Cycles of Blender {} renders {}, {}x{} per eye, at most {} samples per pixel", scene.blender,
                   frames == 1 ? "a picture" : fmt::format("{} frames", frames), picture.eye.width, picture.eye.height,
                   picture.shot.samples));
  if (job.camera.stereo.lens_radius > 0.0f) note("the lens blurs as Cycles' does, which differs towards the poles");
  if (picture.denoiser == ods::Denoiser::kNone && !keeps_light(job.output) && !job.denoise) {
    note("not denoised: one sample does not show its noise");
  }
}

// The first lines about a frame that is made.
class FirstFrame {
 public:
  explicit FirstFrame(const RenderJob& job) : job_(job) {}

  void say(const CyclesSaved& saved) {
    if (std::exchange(said_, true)) return;
    const std::string camera = job_.cycles->scene().camera;
    const ods::vec3 at = saved.pose.position;
    note(fmt::format("camera at {:.4g},{:.4g},{:.4g}, yaw {:.4g} ({})", at.x, at.y, at.z, saved.pose.yaw,
                     job_.camera.position || camera.empty() ? "--position" : "the scene's camera '" + camera + "'"));
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

// One picture: its parts are kept beside it until it is complete.
std::vector<std::string> render_picture(const RenderJob& job, const ods::SequenceFrame& frame,
                                        const std::function<void(double)>& report) {
  CyclesPicture picture = picture_of(job);
  picture.shot.frame = file_frame(job, frame.time);
  picture.shot.seed = frame.seed;
  ods::VideoJournal journal(job.output, cycles_identity(job), job.restart);
  const std::vector<int> numbers = part_numbers(picture);
  journal.plan(numbers, numbers);
  const ods::FrameNames parts = *ods::frame_names(journal.pattern());
  const auto is_there = [&](int number) { return ods::is_saved(parts.path(number)); };
  const auto there = std::ranges::count_if(numbers, is_there);
  if (there > 0) note(fmt::format("resuming: {} of {} parts exist already", there, numbers.size()));
  report_start(job, picture, 1);
  const CyclesSaved saved = make_picture(*job.cycles, picture, parts, job.output, [&](double done) {
    journal.check();
    report(done);
  });
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

}  // namespace

void open_in_cycles(RenderJob& job) {
  check_cycles_scene(job.scene.name);
  if (job.camera.changes.merge_limit) {
    throw UsageError(
        "--merge auto cannot be used with --renderer cycles: ods convert --merge auto changes an .exr that is finished");
  }
  BlenderOptions blender = job.scene.blender;
  blender.scene = job.scene.scene;
  if (find_blender(blender).empty()) {
    throw ods::Error(ods::ErrorKind::kInput,
                     "--renderer cycles needs Blender: install it, or name it with --blender PATH");
  }
  const GivenLight light = read_light(job);
  job.cycles = std::make_shared<CyclesSession>(blender, job.scene.name, job.camera.view_point);
  const CyclesScene& scene = job.cycles->scene();
  job.scene.foreign = scene.foreign;
  for (const std::string& warning : scene.foreign.warnings) warn(warning);
  if (scene.camera.empty() && !job.camera.position) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("'{}' has no camera: --position X,Y,Z places one", job.scene.name));
  }
  surround_scene(job, light);
  job.render.samples = job.quality.samples.value_or(std::max(1, scene.samples));
  job.render.noise = job.quality.noise.value_or(0.0f);
  job.exposure = job.exposure.value_or(scene.exposure);
  const bool is_plain = scene.view == "Standard" || scene.view == "Raw";
  if (!job.tone) job.tone = is_plain ? ods::ToneCurve::kLinear : ods::ToneCurve::kNeutral;
}

TimeOptions cycles_time(const RenderJob& job) {
  TimeOptions time = job.time;
  if (!time.grain) time.grain = Grain::kFixed;
  ods::Scene nothing;
  start_clock(time, job.camera, nothing);
  if (time.is_video && time.file.count == 0 && time.frames.empty() && !time.duration) {
    throw UsageError("nothing moves in the file: add --duration SECONDS or --frames LIST");
  }
  return time;
}

ods::Settings cycles_identity(const RenderJob& job) {
  ods::Settings settings = {{"`renderer`", "cycles", ""}, {"Blender", job.cycles->scene().blender, ""}};
  const ods::Settings rest = frame_identity(identified(job));
  settings.insert(settings.end(), rest.begin(), rest.end());
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
  CyclesFrames frames{all, ods::choose_frames(all, chosen, time.skip_existing), time.skip_existing, {}, {}};
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
    frames.saved(render_picture(job, all.front(), [&](double done) { frames.report(done, {1, 1, job.output}); }));
  }
  note(fmt::format("rendered in {}", duration_text(seconds_since(start))));
}
