// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/studio/live_render.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "ods/base/error.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/denoise/denoise.h"
#include "ods/kernel/camera/project.h"
#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "ods/scene/motion.h"
#include "ods/stage/judge_scene.h"

namespace ods {

using Clock = std::chrono::steady_clock;

namespace {

// The steps of rendering after a change, in order. Denoising needs at least two samples.
struct Step {
  bool is_patch;
  float size;  // for the base: pixels across; for the patch: relative to its full width
  int samples;
};
constexpr Step kSteps[] = {
    {false, 128, 2}, {true, 0.2f, 2}, {false, 512, 2},  {true, 0.4f, 2}, {true, 0.7f, 2},
    {true, 1, 4},    {false, 768, 4}, {true, 1, 8},     {true, 1, 16},   {false, 768, 16},
    {true, 1, 32},   {true, 1, 64},   {false, 768, 64}, {true, 1, 128},
};
constexpr size_t kFirstOfPatch = 1;
static_assert(kSteps[kFirstOfPatch].is_patch);

// From this step on a light cache pays off: filling it takes a second or two of a core.
constexpr size_t kFirstCached = 5;
constexpr int kCachePaths = 1 << 18;

constexpr float kScreen = 1280.0f;        // pixels across a view
constexpr float kMaxPatchShare = 0.8e6f;  // maximum pixels of an eye
constexpr float kLookMargin = 1.15f;      // the patch is larger than the view, so that it covers small turns

// A picture that is refined step by step.
struct Canvas {
  StereoCamera camera;
  RenderOptions options;
  PictureSamples samples;
  std::shared_ptr<const Picture> picture;  // denoised; null if not rendered yet
  bool is_patch = false;
};

Canvas make_canvas(const StereoCamera& camera, bool is_patch, Extent size) {
  Canvas canvas;
  canvas.camera = camera;
  canvas.is_patch = is_patch;
  canvas.options.width = size.width;
  canvas.options.height = size.height;
  canvas.options.statistics = true;
  canvas.options.even_noise = false;
  canvas.options.caustics = Caustics::kStraight;
  canvas.options = with_height(canvas.options, camera);
  canvas.samples = no_samples(canvas.options);
  return canvas;
}

Extent scaled(Extent size, float factor) {
  const auto pixels = [&](int whole) { return std::max(static_cast<int>(static_cast<float>(whole) * factor), 1); };
  return {pixels(size.width), pixels(size.height)};
}

std::vector<uint8_t> display(const Picture& picture, float exposure, ToneCurve tone) {
  const size_t pixels = picture.eyes[0].radiance.pixels.size() / 3;
  std::vector<uint8_t> bytes(picture.eyes.size() * pixels * 3);
  for (size_t eye = 0; eye < picture.eyes.size(); eye++) {
    const std::vector<float>& light = picture.eyes[eye].radiance.pixels;
    tbb::parallel_for(size_t{0}, pixels, [&](size_t i) {
      const vec3 color = tone_map(vec3(light[3 * i], light[3 * i + 1], light[3 * i + 2]), exposure, tone);
      for (int c = 0; c < 3; c++) {
        bytes[(eye * pixels + i) * 3 + static_cast<size_t>(c)] =
            static_cast<uint8_t>(std::lround(255.0f * srgb_encode(color[c])));
      }
    });
  }
  return bytes;
}

// The part of the sphere that contains a view whose tangents are enlarged by the margin, in degrees.
struct Window {
  float half_width, low, high;
};

Window window_of(const LiveView& view, float margin) {
  const float across = margin * std::tan(0.5f * glm::radians(std::clamp(view.fov, 1.0f, 150.0f)));
  const float up = across / std::max(view.aspect, 0.1f), pitch = glm::radians(view.pitch);
  const auto latitude = [&](float x, float y) {
    return glm::degrees(std::asin((std::sin(pitch) + y * std::cos(pitch)) / std::sqrt(1.0f + x * x + y * y)));
  };
  Window window;
  window.low = std::min(latitude(0.0f, -up), latitude(across, -up));
  window.high = std::max(latitude(0.0f, up), latitude(across, up));
  // The corners closest to a pole have the largest range of headings; beyond the pole, all headings.
  const float ahead = std::cos(pitch) - up * std::sin(std::abs(pitch));
  window.half_width = ahead > 0.0f ? glm::degrees(std::atan(across / ahead)) : 180.0f;
  if (ahead <= 0.0f) (view.pitch < 0.0f ? window.low : window.high) = view.pitch < 0.0f ? -90.0f : 90.0f;
  return window;
}

bool shows(const StereoCamera& patch, const LiveView& view) {
  const Window window = window_of(view, 1.0f);
  const vec2 longitude = patch.projection.longitude, latitude = patch.projection.latitude;
  const float turned = std::abs(std::remainder(view.yaw - 0.5f * (longitude.x + longitude.y), 360.0f));
  const float half = 0.5f * (longitude.y - longitude.x);
  return (half >= 180.0f || turned + window.half_width <= half) && window.low >= latitude.x &&
         window.high <= latitude.y;
}

// The point that an eye sees at a position of its picture. whole: the camera whose picture LivePick's positions refer
// to.
std::optional<LivePick> pick_at(const LiveSeen& seen, const Camera& camera, int eye, vec2 uv, const Camera& whole) {
  const Image& depth = seen.picture->eyes[static_cast<size_t>(eye)].depth;
  const glm::ivec2 pixel = pixel_at(uv, depth);
  LivePick pick;
  pick.distance = *depth.at(pixel.x, pixel.y);
  if (pick.distance >= kFarDepth) return {};
  const Ray ray = camera_ray(camera, eye, pixel_middle(pixel.x, pixel.y, depth));
  pick.point = ray.origin + ray.direction * pick.distance;
  vec3 toward[2];
  for (const int each : {kLeft, kRight}) {
    const ImagePosition position = project_point(whole, each, pick.point);
    toward[each] = normalize(pick.point - position.origin);
    if (position.seen) pick.places[each] = position.uv;
  }
  const float chord = 0.5f * length(toward[0] - toward[1]);
  pick.disparity = glm::degrees(2.0f * std::asin(std::min(chord, 1.0f))) * 60.0f;
  return pick;
}

}  // namespace

StereoCamera patch_camera(StereoCamera camera, const LiveView& view) {
  const Window window = window_of(view, kLookMargin);
  camera.projection = ProjectionSetting();
  camera.projection.longitude = vec2(view.yaw - window.half_width, view.yaw + window.half_width);
  camera.projection.latitude = vec2(window.low, window.high);
  return camera;
}

Extent patch_extent(const StereoCamera& patch) {
  const vec2 longitude = patch.projection.longitude, latitude = patch.projection.latitude;
  const float width = longitude.y - longitude.x, height = latitude.y - latitude.x;
  const float wanted = kScreen * kLookMargin / std::min(width, height * 2.0f);  // pixels per degree
  const float per_degree = std::min(wanted, std::sqrt(kMaxPatchShare / (width * height)));
  const auto pixels = [&](float degrees) { return std::max(static_cast<int>(degrees * per_degree), 1); };
  return {pixels(width), pixels(height)};
}

struct LiveRender::State {
  State(Scene& wanted, int threads, Clock::duration rest)
      : rest_after(rest), scene(wanted), renderer(wanted, threads) {}

  const Clock::duration rest_after;

  // Shared with other threads.
  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  LiveSettings settings;
  LiveView view;
  int revision = 0;  // 0 if there are no settings yet
  bool ended = false;
  Clock::time_point since;                         // time of the last change of the settings
  mutable int waiting = 0;                         // threads that wait for a frame
  mutable Clock::time_point asked = Clock::now();  // last time that a frame was requested
  int last_number = 0;
  std::shared_ptr<const LiveFrame> frames[2];  // the base and the patch
  LiveSeen seen[2];                            // the base and the patch
  StereoCamera found;                          // camera of the settings of this revision:
  int found_revision = 0;
  std::string fault;

  // Used only by the render thread.
  Scene& scene;
  CpuRenderer renderer;
  double scene_time = 0.0;
  LiveSettings rendered;  // the settings of the canvases
  StereoCamera merged;    // their camera, with the merge by depth
  std::optional<Canvas> base, patch;
  std::optional<LightCells> cells;  // for both; not set if not filled yet
  size_t next = 0;                  // index of the next step
  std::thread thread;

  void run();
  void begin(int mine, const LiveSettings& now);
  void render_step(int mine);
  void wait_for_change(int mine);
  void wait_for_viewer(int mine) const;
  void fill_cells(const Progress& progress);
  bool refine(Canvas& canvas, int samples, int mine);
  void publish(const Canvas& canvas, int mine, size_t coming);
  StereoCamera camera_of(const Step& step, const LiveView& here) const;
  LiveView view_now() const {
    const std::lock_guard<std::mutex> lock(mutex);
    return view;
  }
  bool is_old(int mine) const {
    const std::lock_guard<std::mutex> lock(mutex);
    return ended || revision != mine;
  }
};

// The viewer may turn in any direction, so the whole picture's paths fill the cells.
void LiveRender::State::fill_cells(const Progress& progress) {
  RenderOptions options = base->options;
  options.indirect = Indirect::kCache;
  options.cache_paths = kCachePaths;
  cells = renderer.fill_cells({&merged, 1}, options, progress);
}

// Returns false if it was cancelled; the samples are then unusable.
bool LiveRender::State::refine(Canvas& canvas, int samples, int mine) {
  Progress progress;
  progress.cancelled = [&] { return is_old(mine) || (canvas.is_patch && !shows(canvas.camera, view_now())); };
  canvas.options.samples = samples;
  try {
    if (!cells && next >= kFirstCached) fill_cells(progress);
    renderer.sample({&canvas.camera, 1}, canvas.options, canvas.samples, progress, {}, cells ? &*cells : nullptr);
    Picture picture = develop(canvas.samples, canvas.options);
    denoise(picture, canvas.camera, {}, progress);
    canvas.picture = std::make_shared<const Picture>(std::move(picture));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kCancelled) throw;
    canvas.samples = no_samples(canvas.options);
    return false;
  }
  return true;
}

StereoCamera LiveRender::State::camera_of(const Step& step, const LiveView& here) const {
  if (!step.is_patch) return merged;
  return patch ? patch->camera : patch_camera(merged, here);
}

static Extent size_of(const Step& step, const StereoCamera& camera) {
  return step.is_patch ? scaled(patch_extent(camera), step.size) : Extent{static_cast<int>(step.size), 0};
}

// coming: the index of the next step.
void LiveRender::State::publish(const Canvas& canvas, int mine, size_t coming) {
  auto frame = std::make_shared<LiveFrame>();
  frame->revision = mine;
  frame->is_patch = canvas.is_patch;
  frame->camera = canvas.camera;
  frame->eye = {canvas.options.width, canvas.options.height};
  frame->pixels = display(*canvas.picture, rendered.exposure, rendered.tone);
  frame->samples = canvas.options.samples;
  if (coming < std::size(kSteps)) {
    const Step& step = kSteps[coming];
    const int width = size_of(step, camera_of(step, view_now())).width;
    const std::optional<Canvas>& same = step.is_patch ? patch : base;  // it may already be larger
    frame->next = {step.is_patch, std::max(width, same ? same->options.width : 0), step.samples};
  }
  const std::lock_guard<std::mutex> lock(mutex);
  if (revision != mine) return;
  frame->number = ++last_number;
  frame->seconds = std::chrono::duration<double>(Clock::now() - since).count();
  frames[canvas.is_patch] = frame;
  seen[canvas.is_patch] = {canvas.camera, canvas.picture};
  changed.notify_all();
}

// A change of exposure or tone curve only redisplays the existing picture; all other changes restart rendering.
void LiveRender::State::begin(int mine, const LiveSettings& now) {
  LiveSettings but_for_display = now;
  but_for_display.exposure = rendered.exposure, but_for_display.tone = rendered.tone;
  const bool same_light = but_for_display == rendered;
  rendered = now;
  if (now.time != scene_time) renderer.update(set_time(scene, scene_time = now.time));
  if (!same_light) {
    base.reset(), patch.reset(), cells.reset();
    next = 0;
    merged = now.camera;
    if (now.merge_limit) use_merge_map(merged, merge_map_of(shares_seen(renderer, merged, *now.merge_limit)));
  }
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (!same_light) std::ranges::fill(frames, nullptr);
    found = merged;
    found_revision = mine;
    changed.notify_all();
  }
  if (base && base->picture) publish(*base, mine, next);
  if (patch && patch->picture) publish(*patch, mine, next);
}

void LiveRender::State::render_step(int mine) {
  const LiveView here = view_now();
  if (patch && !shows(patch->camera, here)) {
    patch.reset();
    next = std::min(next, kFirstOfPatch);
  }
  if (next == std::size(kSteps)) return wait_for_change(mine);
  const Step& step = kSteps[next];
  std::optional<Canvas>& canvas = step.is_patch ? patch : base;
  const StereoCamera camera = camera_of(step, here);
  const Extent size = size_of(step, camera);
  if (!canvas || canvas->options.width < size.width) canvas = make_canvas(camera, step.is_patch, size);
  if (canvas->samples.done < step.samples) {
    if (!refine(*canvas, step.samples, mine)) return;
    publish(*canvas, mine, next + 1);
  }
  next++;
}

void LiveRender::State::wait_for_change(int mine) {
  std::unique_lock<std::mutex> lock(mutex);
  changed.wait(lock, [&] { return ended || revision != mine || !shows(patch->camera, view); });
}

void LiveRender::State::wait_for_viewer(int mine) const {
  std::unique_lock<std::mutex> lock(mutex);
  changed.wait(lock, [&] { return ended || revision != mine || waiting > 0 || Clock::now() - asked < rest_after; });
}

void LiveRender::State::run() {
  for (int mine = 0;;) {
    LiveSettings now;
    {
      std::unique_lock<std::mutex> lock(mutex);
      changed.wait(lock, [&] { return ended || revision != mine; });
      if (ended) return;
      mine = revision;
      now = settings;
      fault.clear();
    }
    try {
      begin(mine, now);
      while (!is_old(mine)) {
        render_step(mine);
        wait_for_viewer(mine);
      }
    } catch (const std::exception& error) {
      base.reset(), patch.reset(), cells.reset();
      rendered = LiveSettings();
      rendered.time = -1.0;  // matches no settings, so that the next ones restart rendering
      const std::lock_guard<std::mutex> lock(mutex);
      fault = error.what();
      changed.notify_all();
    }
  }
}

LiveRender::LiveRender(Scene& scene, int threads, std::chrono::milliseconds rest_after)
    : state_(std::make_unique<State>(scene, threads, rest_after)) {
  state_->rendered.time = -1.0;
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

LiveRender::~LiveRender() {
  end();
  state_->thread.join();
}

void LiveRender::end() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->ended = true;
  state_->changed.notify_all();
}

int LiveRender::set(const LiveSettings& settings, const LiveView& view) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->view = view;
  if (state_->revision == 0 || !(settings == state_->settings)) {
    state_->settings = settings;
    state_->revision++;
    state_->fault.clear();
    state_->since = Clock::now();
  }
  state_->changed.notify_all();
  return state_->revision;
}

void LiveRender::look(const LiveView& view) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->view = view;
  state_->changed.notify_all();
}

std::shared_ptr<const LiveFrame> LiveRender::next_frame(int number, std::chrono::milliseconds patience) const {
  std::unique_lock<std::mutex> lock(state_->mutex);
  state_->waiting++;
  state_->changed.notify_all();
  std::shared_ptr<const LiveFrame> found;
  state_->changed.wait_for(lock, patience, [&] {
    for (const auto& frame : state_->frames) {
      if (!found && frame && frame->number > number) found = frame;
    }
    return found || state_->ended || !state_->fault.empty();
  });
  state_->waiting--;
  state_->asked = Clock::now();
  return found;
}

std::string LiveRender::fault() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->fault;
}

LiveSeen LiveRender::whole() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->seen[0];
}

StereoCamera LiveRender::camera() const {
  std::unique_lock<std::mutex> lock(state_->mutex);
  const auto is_found = [&] { return state_->found_revision == state_->revision; };
  state_->changed.wait(lock, [&] { return is_found() || state_->ended || !state_->fault.empty(); });
  if (is_found()) return state_->found;
  throw Error(ErrorKind::kInput, state_->ended ? "the scene is not rendered any more" : state_->fault);
}

std::optional<LivePick> LiveRender::pick(int eye, vec3 direction) const {
  std::array<LiveSeen, 2> seen;  // the base, the patch
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    std::ranges::copy(state_->seen, seen.begin());
  }
  for (const LiveSeen& each : {seen[1], seen[0]}) {
    if (!each.picture) continue;
    const Camera camera = make_camera(each.camera);
    const ImagePoint place = place_of_line(camera, eye, direction);
    if (place.seen) return pick_at(each, camera, eye, place.uv, make_camera(seen[0].camera));
  }
  return {};
}

}  // namespace ods
