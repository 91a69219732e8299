// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "cli/options/camera_options.h"
#include "cli/view/comfort_answers.h"
#include "cli/view/render_arguments.h"
#include "ods/base/json_reader.h"
#include "ods/base/large_blocks.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/camera/camera_fields.h"
#include "ods/comfort/strain.h"
#include "ods/files/atomic_file.h"
#include "ods/files/read_file.h"
#include "ods/image/format/file_format.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/stage/exposure.h"
#include "ods/view/camera_json.h"

using ods::Json, ods::JsonReader, ods::LiveFrame;

namespace {

constexpr std::chrono::milliseconds kPatience{5000};  // for the next frame
constexpr std::chrono::milliseconds kShortPatience{200};
constexpr int kMaxWaiting = 16;  // with patience, so that connections are left for the rest of the site
constexpr int kMaxWidth = 16384;
constexpr float kLeastLimit = 1.0f, kMostLimit = 600.0f;  // of a merge by depth, as --merge auto has them
constexpr const char* kEnvironments[] = {"auto", "studio", "sky", "white", "0"};
constexpr const char* kQualities[] = {"draft", "preview", "final"};

// The exposure for the light, as ods render chooses it.
float usual_exposure(const ods::Scene& scene, const ods::StereoCamera& camera) {
  const ods::Picture look = render_cpu(scene, ods::metering_camera(camera), ods::metering_options({}));
  return ods::suitable_exposure({&look, 1}).value_or(0.0f);
}

void read_look(JsonReader& reader, ods::LiveView& view) {
  reader.number("yaw", view.yaw, -360.0f, 360.0f);
  reader.number("pitch", view.pitch, -90.0f, 90.0f);
  reader.number("fov", view.fov, 1.0f, 170.0f);
  reader.number("aspect", view.aspect, 0.1f, 10.0f);
}

void read_text(JsonReader& reader, const std::string& key, std::string& text) {
  const Json* const json = reader.find(key);
  if (json && json->is_string()) text = *json;
}

// The limit of a merge by depth: null for none, absent for the present one.
void read_limit(JsonReader& reader, std::optional<float>& limit) {
  if (reader.is_null("merge_limit")) return limit.reset();
  if (!limit && reader.find("merge_limit")) limit.emplace();
  if (limit) reader.number("merge_limit", *limit, kLeastLimit, kMostLimit);
}

template <class Read>
void read_body(const std::string& body, const Read& read) {
  const Json json = ods::parse_json(body, "request", "request");
  std::vector<std::string> warnings;
  JsonReader reader(json, "request", "request", "", warnings);
  read(reader);
}

template <class Names>
void check_name(const std::string& what, const std::string& name, const Names& names) {
  if (std::ranges::find(names, name) == std::end(names)) {
    throw UsageError(fmt::format("there is no {} '{}'", what, name));
  }
}

// The numbers of a projection, by the page's names.
Json controls_json(int kind) {
  Json json = Json::array();
  if (ods::has_range(kind)) json.push_back("range");
  if (ods::has_fov(kind)) json.push_back("fov");
  if (ods::has_lens(kind)) json.push_back("lens");
  if (kind == ods::kPerspective) json.push_back("aspect");
  if (kind == ods::kFisheyePolynomial) json.push_back("polynomial");
  return json;
}

// The default lens of a fisheye-polynomial, as in a sidecar.
Json polynomial_lens_json() {
  ods::Sidecar usual;
  usual.camera.projection = ods::find_projection("fisheye-polynomial")->setting;
  const Json projection = Json::parse(write_sidecar(usual)).at("projection");
  return {{"sensor", projection.at("sensor")}, {"polynomial", projection.at("polynomial")}};
}

// The kernel's number of each merge.
Json kernel_merges_json() {
  Json json = Json::object();
  for (const auto& row : ods::kMergeTable) json[std::string(row.name)] = row.member;
  return json;
}

Json ranges_json() {
  Json json = Json::object();
  for (const ods::CameraFieldRow& row : ods::camera_fields()) {
    json[std::string(row.place)] = {row.range.minimum, row.range.maximum};
  }
  return json;
}

// Rounds values set by sliders or dragging, so that the command shown is short.
float rounded(float value, double per_unit) {
  return static_cast<float>(std::round(value * per_unit) / per_unit);
}

ods::StereoCamera shortened(ods::StereoCamera camera) {
  const double per_metre = camera.ipd < 0.01f ? 1e6 : 1e3;  // a small world has small steps
  for (int i = 0; i < 3; i++) camera.position[i] = rounded(camera.position[i], per_metre);
  for (float* const angle : {&camera.yaw, &camera.pitch, &camera.roll}) *angle = rounded(*angle, 100.0);
  return camera;
}

// The scene's own cameras.
Json cameras_json(const std::vector<ods::ViewPoint>& points) {
  Json json = Json::array();
  for (const ods::ViewPoint& at : points) {
    json.push_back({{"name", at.name}, {"yaw", at.yaw}, {"position", {at.position.x, at.position.y, at.position.z}}});
  }
  return json;
}

// Counts those who wait for a frame.
struct Waiting {
  explicit Waiting(std::atomic<int>& all) : all_(all), count_(++all) {}
  ~Waiting() { all_--; }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  int count() const { return count_; }

 private:
  std::atomic<int>& all_;
  int count_;
};

}  // namespace

WebAnswer json_answer(const Json& json) {
  return {.type = "application/json", .body = ods::json_document(json)};
}

Studio::Studio(const SceneSource& source, std::function<size_t(const std::string& path)> add_item)
    : add_item_(std::move(add_item)) {
  open(source, true);
}

Studio::Settings Studio::suiting(const SceneSource& source, const ods::Scene& scene) {
  Settings settings;
  CameraOptions camera;
  take_base(camera, source.foreign, source.blender);
  settings.sidecar.camera = shortened(place_camera(camera, scene));
  settings.live.camera = settings.sidecar.camera;
  const bool needs_none = ods::find_builtin(source.name) || scene.as_painted;
  settings.live.exposure = needs_none ? 0.0f : rounded(usual_exposure(scene, settings.live.camera), 100.0);
  const bool has_merge = source.foreign && source.foreign->has_stereo;
  if (!has_merge) settings.live.merge_limit = static_cast<float>(ods::kFusionLimit);
  settings.live.tone = ods::usual_tone(scene);
  const std::optional<ods::SkyOptions> sky = described_sky("--env", source.light.environment);
  settings.sky = sky.value_or(ods::SkyOptions());
  settings.environment = sky ? "sky" : source.light.environment.empty() ? "auto" : source.light.environment;
  settings.turn = source.light.turn;
  settings.strength = source.light.strength;
  settings.variant = source.variant;
  return settings;
}

// Another scene, with the settings that suit it, or another light of the same. Nothing changes if it throws.
void Studio::open(const SceneSource& source, bool is_new) {
  struct Opened {
    explicit Opened(ods::Scene wanted) : scene(std::move(wanted)), live(scene, 0) {}
    ods::Scene scene;
    ods::LiveRender live;
  };
  const auto opened = std::make_shared<Opened>(open_lit_scene(source, false));
  if (is_new) usual_ = settings_ = suiting(source, opened->scene);
  if (live_) live_->end();
  source_ = source;
  scene_ = {opened, &opened->scene};
  live_ = {opened, &opened->live};
  duration_ = length_of(scene_->animation);
  ods::return_free_memory();  // of the scene before
  if (!is_new) return;
  saved_.clear();
  live_->set(settings_.live, settings_.look);
}

// Maps that we have are numbers: the page sends all settings whenever one changes.
Json Studio::settings_json(const Settings& settings) const {
  ods::Sidecar sidecar = settings.sidecar;
  const auto number_of = [&](std::shared_ptr<const ods::Image>& map) {
    const auto found = map ? std::ranges::find(maps_, map) : maps_.end();
    if (found == maps_.end()) return -1;
    map = nullptr;
    return static_cast<int>(found - maps_.begin());
  };
  const Json maps = {{"merge", number_of(sidecar.camera.merge_map)},
                     {"head_tilt", number_of(sidecar.camera.head_tilt_map)}};
  return {{"sidecar", Json::parse(write_sidecar(sidecar))},
          {"maps", maps},
          {"merge_limit", settings.live.merge_limit ? Json(*settings.live.merge_limit) : Json()},
          {"exposure", settings.live.exposure},
          {"tone", ods::tone_curve_name(settings.live.tone)},
          {"env", settings.environment},
          {"sun", {{"elevation", settings.sky.elevation}, {"azimuth", settings.sky.azimuth}}},
          {"turn", settings.turn},
          {"strength", settings.strength},
          {"variant", settings.variant},
          {"time", settings.live.time},
          {"width", settings.width}};
}

Json Studio::description() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Json json = {{"scene", std::filesystem::path(title()).filename().string()},
               {"settings", settings_json(usual_)},
               {"ranges", ranges_json()},
               {"cameras", cameras_json(scene_->view_points)},
               {"merges", ods::names_of(ods::kMergeTable)},
               {"kernel_merges", kernel_merges_json()},
               {"convergences", ods::names_of(ods::kConvergenceTable)},
               {"projections", Json::array()},
               {"polynomial_lens", polynomial_lens_json()},
               {"tones", ods::names_of(ods::kToneCurveTable)},
               {"envs", kEnvironments},
               {"qualities", kQualities},
               {"variants", scene_->variants},
               {"duration", duration_}};
  for (const ods::NamedProjection& named : ods::named_projections()) {
    json["projections"].push_back(named.name);
    json["controls"][std::string(named.name)] = controls_json(named.setting.kind);
  }
  return json;
}

void Studio::read_camera(JsonReader& reader, Settings& settings) const {
  const Json* const given = reader.find("sidecar");
  if (!given) return;
  Json sidecar = *given;
  int merge = -1, head_tilt = -1;
  reader.part("maps", [&](JsonReader& maps) {
    maps.integer("merge", merge, -1, Studio::kMaxMaps);
    maps.integer("head_tilt", head_tilt, -1, Studio::kMaxMaps);
  });
  if (std::max(merge, head_tilt) >= static_cast<int>(maps_.size())) {
    throw UsageError("the camera's map is gone: drop its .camera.json once more");
  }
  if (merge >= 0) sidecar["merge_map"] = {{"width", 1}, {"height", 1}, {"values", {1}}};  // replaces our map
  std::vector<std::string> warnings;
  settings.sidecar = ods::read_sidecar(ods::json_document(sidecar), "camera", warnings);
  ods::StereoCamera& camera = settings.sidecar.camera;
  if (merge >= 0) camera.merge_map = maps_[static_cast<size_t>(merge)];
  if (head_tilt >= 0) camera.head_tilt_map = maps_[static_cast<size_t>(head_tilt)];
  settings.live.camera = camera;
}

Studio::Settings Studio::read_settings(const std::string& text) const {
  Settings settings = settings_;
  read_body(text, [&](JsonReader& reader) {
    read_camera(reader, settings);
    const std::string fault = camera_fault(settings.live.camera);
    if (!fault.empty()) throw UsageError("the camera's " + fault);
    read_limit(reader, settings.live.merge_limit);
    reader.number("exposure", settings.live.exposure, -ods::kMaxStops, ods::kMaxStops);
    const std::string tone = reader.word("tone");
    if (!tone.empty()) {
      const auto curve = ods::find_in(ods::kToneCurveTable, tone);
      if (!curve) throw UsageError(fmt::format("there is no tone curve '{}'", tone));
      settings.live.tone = *curve;
    }
    float time = static_cast<float>(settings.live.time);
    reader.number("time", time, 0.0f, static_cast<float>(std::max(duration_, 0.0)));
    settings.live.time = static_cast<double>(time);
    reader.integer("width", settings.width, 64, kMaxWidth);
    read_text(reader, "env", settings.environment);
    reader.part("sun", [&](JsonReader& sun) {
      sun.number("elevation", settings.sky.elevation, 0.0f, 90.0f);
      sun.number("azimuth", settings.sky.azimuth, -360.0f, 360.0f);
    });
    reader.number("turn", settings.turn, -360.0f, 360.0f);
    reader.number("strength", settings.strength, 0.0f, 1e6f);
    read_text(reader, "variant", settings.variant);
    reader.part("look", [&](JsonReader& look) { read_look(look, settings.look); });
  });
  // Files are named on the command line only: users of the page may not read others.
  if (settings.environment != usual_.environment) check_name("light", settings.environment, kEnvironments);
  if (settings.variant != usual_.variant) check_name("variant", settings.variant, scene_->variants);
  return settings;
}

WebAnswer Studio::set(const std::string& body) {
  const Settings wanted = read_settings(body);
  SceneSource source = source_;
  source.light.environment = environment_of(wanted, false);
  source.light.turn = wanted.turn;
  source.light.strength = wanted.strength;
  source.variant = wanted.variant;
  if (!(source.light == source_.light) || source.variant != source_.variant) {
    open(source, false);
  }
  settings_ = wanted;
  const int revision = live_->set(settings_.live, settings_.look);
  std::vector<std::string> command = words(saved_.empty() ? stem() : saved_, true);
  command.insert(command.begin(), "ods");
  const std::string end = ods::name_end(settings_.live.camera.projection, settings_.sidecar.layout);
  command.insert(command.end(), {"-o", stem() + end});
  const std::string missing = missing_files(command);
  const std::string note =
      missing.empty() ? "" : fmt::format("This command reads {}: Save camera writes what it reads", missing);
  return json_answer({{"revision", revision}, {"command", ods::shell_line(command)}, {"note", note}, {"end", end}});
}

static const char* part_name(bool is_patch) {
  return is_patch ? "patch" : "base";
}

WebAnswer Studio::frame(const WebRequest& request) {
  const std::string after = value_of(request, "after");
  int number = 0;
  std::from_chars(after.data(), after.data() + after.size(), number);
  std::shared_ptr<ods::LiveRender> live;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    live = live_;
  }
  const Waiting waiting(waiting_);
  // Pages that were closed or reloaded count as waiting until their patience ends.
  const auto patience = waiting.count() > kMaxWaiting ? kShortPatience : kPatience;
  const std::shared_ptr<const LiveFrame> frame = live->next_frame(number, patience);
  const std::string fault = live->fault();
  if (!fault.empty()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    throw ods::Error(ods::ErrorKind::kInput, without_paths(fault));
  }
  if (!frame) return {.status = 204};
  Json next;
  if (frame->next) {
    next = {
        {"part", part_name(frame->next->is_patch)}, {"width", frame->next->width}, {"samples", frame->next->samples}};
  }
  Json merge;
  const ods::StereoCamera& camera = frame->camera;
  if (!frame->is_patch && camera.merge_map) merge = merge_json(*camera.merge_map);
  const std::string head = ods::json_document({{"number", frame->number},
                                               {"revision", frame->revision},
                                               {"part", part_name(frame->is_patch)},
                                               {"width", frame->eye.width},
                                               {"height", frame->eye.height},
                                               {"eyes", 2},
                                               {"camera", camera_json(make_camera(frame->camera))},
                                               {"merge", merge},
                                               {"samples", frame->samples},
                                               {"seconds", frame->seconds},
                                               {"done", !frame->next},
                                               {"next", next},
                                               {"state", "rendering"}});
  std::string body(4, '\0');
  const auto size = static_cast<uint32_t>(head.size());
  for (size_t i = 0; i < 4; i++) body[i] = static_cast<char>(size >> (8 * i) & 0xff);
  body += head;
  body.append(reinterpret_cast<const char*>(frame->pixels.data()), frame->pixels.size());
  return {.type = "application/octet-stream", .body = std::move(body)};
}

WebAnswer Studio::pick(const std::string& body) {
  ods::LiveView at;
  std::string eye;
  read_body(body, [&](JsonReader& reader) {
    read_look(reader, at);
    eye = reader.word("eye");
  });
  const ods::vec3 toward = ods::direction_of(glm::radians(at.yaw), glm::radians(at.pitch));
  const int seen_by = eye == "right" ? ods::kRight : ods::kLeft;
  const auto pick = live_->pick(seen_by, toward);
  if (!pick) return json_answer({{"nothing", true}});
  Json json = {{"distance", pick->distance},
               {"disparity", pick->disparity},
               {"point", {pick->point.x, pick->point.y, pick->point.z}}};
  const int height = natural_height(settings_.live.camera.projection, settings_.width);
  for (const int each : {ods::kLeft, ods::kRight}) {
    if (!pick->places[each]) continue;
    const ods::vec2 pixel = *pick->places[each] * ods::vec2(settings_.width, height);
    json[std::string(ods::eye_name(each))] = {pixel.x, pixel.y};
  }
  add_comfort(json, live_->whole().camera, *pick, seen_by);
  return json_answer(json);
}

// A file name in the folder where ods view was started; nothing else.
static void check_output_name(const std::string& name) {
  const std::string plain = std::filesystem::path(name).filename().string();
  if (name.empty() || plain != name || name.starts_with('.') || name.starts_with('-')) {
    throw UsageError("give the picture a name without a folder, like room_360_TB.png");
  }
  if (std::ranges::any_of(name, [](unsigned char c) { return c == '%' || std::iscntrl(c) != 0; })) {
    throw UsageError("leave % and control characters out of the picture's name");
  }
  if (!ods::format_of_path(name)) throw UsageError(fmt::format("end the name in one of {}", ods::known_extensions()));
  if (std::filesystem::exists(std::filesystem::symlink_status(name)))
    throw UsageError(fmt::format("'{}' exists: give the picture another name", name));
}

WebAnswer Studio::render(const std::string& body) {
  std::string name, quality;
  read_body(body, [&](JsonReader& reader) {
    name = reader.word("output");
    quality = reader.word("quality");
  });
  check_output_name(name);
  check_name("quality", quality, kQualities);
  const std::string maps = fmt::format("{}/{}", drops_.path(), ++drop_count_);
  save_maps(command_camera(), maps);
  std::vector<std::string> all = words(maps, false);
  all.insert(all.end(), {"--quality", quality});
  process_.start(all, name);
  item_.reset();
  return json_answer(Json::object());
}

WebAnswer Studio::job() {
  const RenderProcess::Status status = process_.status();
  Json json = {{"state", status.state},
               {"done", status.done},
               {"left", status.left},
               {"text", without_paths(status.text)},
               {"output", status.output}};
  if (status.state == "done") {
    if (!item_) item_ = add_item_(status.output);
    json["item"] = *item_;
  }
  return json_answer(json);
}

WebAnswer Studio::status() const {
  const std::string fault = live_->fault();
  return json_answer({{"state", fault.empty() ? "rendering" : "failed"}, {"fault", without_paths(fault)}});
}

// Judging takes long: settings that come meanwhile need not wait for it.
WebAnswer Studio::comfort(const WebRequest& request) {
  ods::LiveSeen seen;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    seen = live_->whole();
  }
  if (request.path == "studio/comfort") return json_answer(comfort_json(seen));
  return heat_answer(seen, value_of(request, "eye") == "right" ? ods::kRight : ods::kLeft);
}

WebAnswer Studio::answer(const WebRequest& request) {
  if (request.path == "studio/frame") return frame(request);
  if (request.path == "studio/comfort" || request.path == "studio/heat.png") return comfort(request);
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    return route(request);
  } catch (const ods::Error& error) {
    throw ods::Error(error.kind(), without_paths(error.what()));
  }
}

WebAnswer Studio::route(const WebRequest& request) {
  if (request.path == "studio/job") return job();
  if (request.path == "studio/status") return status();
  if (!request.is_post) return nothing_there();
  if (request.path == "studio/set") return set(request.body);
  if (request.path == "studio/pick") return pick(request.body);
  if (request.path == "studio/render") return render(request.body);
  if (request.path == "studio/save") return save();
  if (request.path == "studio/drop") return drop(request);
  if (request.path == "studio/cancel") {
    process_.cancel();
    return json_answer(Json::object());
  }
  if (request.path == "studio/look") {
    read_body(request.body, [&](JsonReader& reader) { read_look(reader, settings_.look); });
    live_->look(settings_.look);
    return json_answer(Json::object());
  }
  return nothing_there();
}
