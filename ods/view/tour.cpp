// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/tour.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/base/decimal.h"
#include "ods/base/quote.h"
#include "ods/base/suggest.h"
#include "ods/base/text.h"
#include "ods/files/read_file.h"
#include "ods/image/format/file_format.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/metadata/stereo_format.h"

namespace ods {

namespace fs = std::filesystem;

namespace {

constexpr const char* kTourNoun = "tour";
constexpr size_t kMaxTour = 1 << 20;  // bytes
constexpr size_t kMaxPanoramas = 500;
constexpr size_t kMaxName = 100;            // bytes
constexpr float kMaxDistance = 100'000.0f;  // metres
constexpr float kMaxPixels = 100'000.0f;

// A file beside the tour; its path if there is one.
std::string path_beside(const std::string& tour, JsonReader& reader, const std::string& key) {
  const std::string name = text_of(reader, key, 1000, true);
  const fs::path path = fs::path(tour).parent_path() / name;
  std::error_code ignored;
  if (name.empty() || !is_quotable(name)) reader.fail(key, "must be the name of a file");
  if (!fs::is_regular_file(path, ignored)) {
    reader.fail(key, fmt::format("'{}' does not exist: give its path from the folder of the tour", name));
  }
  return path.native();
}

// hall_360_TB.jpg -> hall
std::string plain_name(const std::string& path) {
  const std::string stem = fs::path(path).stem().native();
  const size_t end = std::min(stem.find("_360"), stem.find("_180"));
  return end == 0 ? stem : stem.substr(0, end);
}

// The place and the heading by the camera that the picture was made with, if it is known.
void read_camera(TourStop& stop) {
  std::vector<std::string> ignored;
  std::error_code fault;
  const std::string sidecar = sidecar_path(stop.file);
  StereoCamera camera;
  if (fs::is_regular_file(sidecar, fault)) {
    camera = load_sidecar(sidecar, ignored).camera;
  } else if (format_of_path(stop.file) == FileFormat::kExr) {
    try {
      camera = open_camera(stop.file, ignored).camera;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      return;  // another program's
    }
  } else {
    return;
  }
  stop.place = camera.position;
  stop.heading = camera.yaw;
}

std::optional<float> number_of(JsonReader& reader, const std::string& key, float low, float high) {
  if (!reader.find(key)) return {};
  float value = 0.0f;
  reader.number(key, value, low, high);
  return value;
}

TourStop read_stop(const Json& json, const std::string& tour, const std::string& at, float floor,
                   std::vector<std::string>& warnings) {
  const Json named = json.is_string() ? Json{{"file", json}} : json;
  JsonReader reader(named, tour, kTourNoun, at, warnings);
  TourStop stop;
  stop.file = path_beside(tour, reader, "file");
  read_camera(stop);
  stop.title = text_of(reader, "title", kMaxHotspotTitle, false);
  if (stop.title.empty()) stop.title = plain_name(stop.file);
  stop.name = text_of(reader, "name", kMaxName, false);
  if (stop.name.empty()) stop.name = plain_name(stop.file);
  stop.text = text_of(reader, "text", kMaxHotspotText, false);
  std::vector<float> place;
  if (reader.numbers("place", place, 3, -kMaxDistance, kMaxDistance)) stop.place = vec3(place[0], place[1], place[2]);
  vec2 pixel(0.0f);
  if (reader.vector("on_plan", pixel, -kMaxPixels, kMaxPixels)) {
    if (!place.empty()) reader.fail("on_plan", "and place are both there: give one of them");
    stop.on_plan = pixel;
    stop.place.reset();
  }
  if (const auto heading = number_of(reader, "heading", -36000.0f, 36000.0f)) stop.heading = heading;
  stop.floor = floor;
  reader.number("floor", stop.floor, -kMaxDistance, kMaxDistance);
  if (stop.place && stop.place->y <= stop.floor) {
    reader.fail("floor", fmt::format("must be below the camera, whose y is {:g}", stop.place->y));
  }
  stop.hotspots = hotspots_of(reader, tour, kTourNoun, at + ".", warnings);
  reader.find("links");  // by read_links(), when all names are known
  reader.finish();
  return stop;
}

size_t find_stop(const Tour& tour, JsonReader& link) {
  const std::string name = text_of(link, "to", kMaxName, true);
  const auto found = std::ranges::find(tour.panoramas, name, &TourStop::name);
  if (found != tour.panoramas.end()) return static_cast<size_t>(found - tour.panoramas.begin());
  std::vector<std::string> names;
  for (const TourStop& stop : tour.panoramas) names.push_back(stop.name);
  link.fail("to", fmt::format("leads nowhere: no panorama is called '{}'{}", name, did_you_mean(name, names)));
}

// Links are names, or objects with directions.
void read_links(const Json& json, const std::string& file, size_t number, Tour& tour,
                std::vector<std::string>& warnings) {
  if (!json.is_object() || !json.contains("links")) return;
  const std::string at = fmt::format("panoramas.{}", number);
  JsonReader reader(json, file, kTourNoun, at, warnings);
  const Json& list = *reader.find("links");
  if (!list.is_array() || list.size() > kMaxPanoramas) {
    reader.fail("links", fmt::format("must be a list of at most {}", kMaxPanoramas));
  }
  std::vector<TourLink>& links = tour.panoramas[number].links.emplace();
  for (const Json& each : list) {
    const Json named = each.is_string() ? Json{{"to", each}} : each;
    JsonReader entry(named, file, kTourNoun, fmt::format("{}.links.{}", at, links.size()), warnings);
    TourLink& link = links.emplace_back();
    link.to = find_stop(tour, entry);
    if (link.to == number) entry.fail("to", "leads to its own panorama");
    link.yaw = number_of(entry, "yaw", -360.0f, 360.0f);
    link.pitch = number_of(entry, "pitch", -90.0f, 90.0f);
    link.distance = number_of(entry, "distance", 0.5f, 1000.0f);
    if (link.pitch && !link.yaw) entry.fail("pitch", "needs a yaw");
    entry.finish();
  }
}

TourPlan read_plan(JsonReader& reader, const std::string& file) {
  TourPlan plan;
  plan.image = path_beside(file, reader, "image");
  const auto format = format_of_path(plan.image);
  if (format != FileFormat::kPng && format != FileFormat::kJpeg && format != FileFormat::kWebp) {
    reader.fail("image", "must be a PNG, a JPEG or a WebP, which browsers show");
  }
  read_info(plan.image);
  if (!reader.find("metres_per_pixel")) reader.fail("metres_per_pixel", "is missing: 0.01 if a metre is 100 pixels");
  reader.number("metres_per_pixel", plan.metres_per_pixel, 1e-5f, 1000.0f);
  reader.vector("origin", plan.origin, -kMaxPixels, kMaxPixels);
  reader.number("heading", plan.heading, -360.0f, 360.0f);
  return plan;
}

// Throws the error of a whole tour, as JsonReader::fail() does that of a key.
[[noreturn]] void refuse(const std::string& file, const std::string& fault) {
  throw Error(ErrorKind::kInput, fmt::format("'{}' is not a valid {}: {}", file, kTourNoun, fault));
}

void check_names(const Tour& tour, const std::string& file) {
  for (auto stop = tour.panoramas.begin(); stop != tour.panoramas.end(); ++stop) {
    if (std::find_if(tour.panoramas.begin(), stop, [&](const TourStop& other) { return other.name == stop->name; }) ==
        stop) {
      continue;
    }
    refuse(file, fmt::format("two panoramas are called '{}': give one of them another \"name\"", stop->name));
  }
}

void check_places(const Tour& tour, const std::string& file) {
  std::vector<bool> needs(tour.panoramas.size());
  for (size_t i = 0; i < needs.size(); i++) {
    const TourStop& stop = tour.panoramas[i];
    if (!stop.links && needs.size() > 1) needs[i] = true;
    for (const TourLink& link : stop.links.value_or(std::vector<TourLink>())) {
      if (!link.yaw) needs[i] = needs[link.to] = true;
    }
    if (stop.on_plan && !tour.plan) refuse(file, fmt::format("panoramas.{}.on_plan needs a plan", i));
  }
  for (size_t i = 0; i < needs.size(); i++) {
    const TourStop& stop = tour.panoramas[i];
    if (!needs[i] || stop.place || stop.on_plan) continue;
    refuse(file,
           fmt::format("panoramas.{} ('{}') has no place: add \"place\": [x, y, z] in metres, \"on_plan\": [x, y] "
                       "in pixels or its .camera.json, or give its links a yaw",
                       i, stop.name));
  }
}

Json place_json(vec3 v) {
  return {decimal(v.x), decimal(v.y), decimal(v.z)};
}

Json pixel_json(vec2 v) {
  return {decimal(v.x), decimal(v.y)};
}

}  // namespace

bool names_tour(const std::string& path) {
  const std::string name = small_letters(path);
  for (const char* const other : {".camera.json", ".notes.json", ".objects.json"}) {
    if (name.ends_with(other)) return false;
  }
  return name.ends_with(".json");
}

Tour read_tour(const std::string& path) {
  const Json json = parse_json(read_text(path, kMaxTour), path, kTourNoun);
  std::vector<std::string> warnings;
  JsonReader reader(json, path, kTourNoun, "", warnings);
  Tour tour;
  float floor = 0.0f;
  reader.number("floor", floor, -kMaxDistance, kMaxDistance);
  reader.number("height", tour.height, 0.1f, 1000.0f);
  const Json* const list = reader.find("panoramas");
  if (!list || !list->is_array() || list->empty() || list->size() > kMaxPanoramas) {
    reader.fail("panoramas", fmt::format("must be a list of 1 to {}", kMaxPanoramas));
  }
  for (const Json& each : *list) {
    const std::string at = fmt::format("panoramas.{}", tour.panoramas.size());
    tour.panoramas.push_back(read_stop(each, path, at, floor, warnings));
  }
  check_names(tour, path);
  for (size_t i = 0; i < list->size(); i++) read_links((*list)[i], path, i, tour, warnings);
  reader.part("plan", [&](JsonReader& plan) { tour.plan = read_plan(plan, path); });
  reader.finish();
  check_places(tour, path);
  if (!warnings.empty()) throw Error(ErrorKind::kInput, warnings.front());
  return tour;
}

std::string plan_file(const TourPlan& plan) {
  return "plan" + small_letters(fs::path(plan.image).extension().native());
}

Json tour_json(const Tour& tour) {
  Json json = {{"height", decimal(tour.height)}, {"panoramas", Json::array()}};
  for (const TourStop& stop : tour.panoramas) {
    Json& entry = json["panoramas"].emplace_back(Json{{"name", stop.name}, {"floor", decimal(stop.floor)}});
    if (stop.heading) entry["heading"] = decimal(*stop.heading);
    if (stop.place) entry["place"] = place_json(*stop.place);
    if (stop.on_plan) entry["on_plan"] = pixel_json(*stop.on_plan);
    if (!stop.links) continue;
    entry["links"] = Json::array();
    for (const TourLink& link : *stop.links) {
      Json& to = entry["links"].emplace_back(Json{{"to", tour.panoramas[link.to].name}});
      if (link.yaw) to["yaw"] = decimal(*link.yaw);
      if (link.pitch) to["pitch"] = decimal(*link.pitch);
      if (link.distance) to["distance"] = decimal(*link.distance);
    }
  }
  if (!tour.plan) return json;
  json["plan"] = Json{{"image", plan_file(*tour.plan)},
                      {"metres_per_pixel", decimal(tour.plan->metres_per_pixel)},
                      {"origin", pixel_json(tour.plan->origin)},
                      {"heading", decimal(tour.plan->heading)}};
  return json;
}

}  // namespace ods
