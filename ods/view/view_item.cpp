// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/view_item.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/convert/convert.h"
#include "ods/files/file_input.h"
#include "ods/image/format/file_format.h"
#include "ods/video/container/video_file.h"
#include "ods/video/video_input.h"
#include "ods/view/camera_json.h"

namespace ods {

// What browsers decode, with each eye in a rectangle of its own.
static bool browsers_read(const std::string& path, const StoredPicture& picture) {
  const auto format = format_of_path(path);
  if (!picture.maps.empty()) return false;
  if (format != FileFormat::kPng && format != FileFormat::kJpeg && format != FileFormat::kWebp) return false;
  return picture.eyes.size() == 1 || arrangement_of(picture.layout).is_halves();
}

// Whether the track of sound that browsers play is ambisonic, with the channels that the page knows
// (web/ambisonics.js).
static bool hears_around(const std::string& path) {
  const std::vector<SoundTrack> sound = read_video_file(path).sound;
  if (sound.empty() || !sound[0].ambisonics) return false;
  return sound[0].ambisonics->channels == 4 && !sound[0].ambisonics->has_head_locked;
}

ViewItem open_view_item(const std::string& path, const FormatHint& known) {
  ViewItem item;
  item.path = path;
  item.known = known;
  item.name = std::filesystem::path(path).filename().string();
  item.notes = read_notes(path);
  if (!names_eye(path) && is_video(path)) {
    const VideoInput video = open_video(path, known);
    if (!video.prototype.maps.empty()) {
      throw Error(ErrorKind::kInput,
                  fmt::format("cannot show '{}': it has fisheyes as its camera stored them, which browsers do not "
                              "unwrap: ods convert makes a video of it that they show",
                              path));
    }
    item.is_video = item.has_own_file = true;
    item.picture = video.prototype;
    item.fps = video.fps;
    item.is_ambisonic = hears_around(path);
    item.subtitles = read_subtitles(path);
    return item;
  }
  OpenOptions options;
  options.format = known;
  options.color_only = true;
  item.picture = PictureReader(path, options).header();
  item.is_light = item.picture.is_float;
  item.has_own_file = !names_eye(path) && browsers_read(path, item.picture);
  return item;
}

std::vector<std::string> item_files(const ViewItem& item, size_t index) {
  if (item.has_own_file) {
    return {fmt::format("item/{}/picture{}", index, std::filesystem::path(item.path).extension().string())};
  }
  std::vector<std::string> files;
  for (const StoredEye& eye : item.picture.eyes) {
    files.push_back(fmt::format("item/{}/{}.jpg", index, eye_name(eye.eye)));
  }
  return files;
}

// Of a file with both eyes: the fractions at which an eye begins, and its size.
static Json eye_rectangle(Layout layout, int eye_count, int index) {
  const Extent eye{2, 2}, whole = packed_size(layout, eye, eye_count);
  const EyeCorner corner = eye_count == 1 ? EyeCorner() : eye_corner(layout, eye, index);
  const auto part = [](int n, int of) { return static_cast<double>(n) / of; };
  return {part(corner.x, whole.width), part(corner.y, whole.height), part(eye.width, whole.width),
          part(eye.height, whole.height)};
}

static Json layouts() {
  Json list = Json::array();
  const Json whole = eye_rectangle(Layout::kSeparate, 1, 0);
  list.push_back({{"name", "mono"}, {"left", whole}, {"right", whole}});
  for (const Layout layout : kLayouts) {
    if (!arrangement_of(layout).is_halves()) continue;
    list.push_back(
        {{"name", layout_name(layout)}, {"left", eye_rectangle(layout, 2, 0)}, {"right", eye_rectangle(layout, 2, 1)}});
  }
  return list;
}

static Json projections() {
  Json list = Json::array();
  for (const NamedProjection& named : named_projections()) {
    StereoCamera camera;
    camera.projection = named.setting;
    list.push_back({{"name", named.name}, {"summary", named.summary}, {"camera", camera_json(make_camera(camera))}});
  }
  return list;
}

static Json item_json(const ViewItem& item, size_t index, bool is_live) {
  const std::vector<std::string> files = item_files(item, index);
  const bool is_mono = item.picture.eyes.size() == 1 || item.picture.front_and_back;
  Json json = {{"name", item.name}, {"kind", item.is_video ? "video" : "picture"}};
  if (item.has_own_file) {
    json["image"] = files[0];
  } else {
    json["left"] = files.front();
    json["right"] = files.back();
  }
  json["layout"] = is_mono ? "mono" : layout_name(item.picture.layout);
  json["layout_reason"] = item.picture.layout_reason;
  json["projection"] = projection_name(item.picture.camera.projection);
  json["camera"] = camera_json(make_camera(item.picture.camera));
  json["size"] = {item.picture.size.width, item.picture.size.height};
  json["notes"] = item.picture.guesses;
  json["live"] = item.is_light;
  if (item.is_light) json["exposure"] = 0, json["tone"] = tone_curve_name(ToneCurve::kNeutral);
  if (!item.notes.caption.empty()) json["caption"] = item.notes.caption;
  for (const Hotspot& spot : item.notes.hotspots) {
    json["hotspots"].push_back({{"yaw", spot.yaw}, {"pitch", spot.pitch}, {"title", spot.title}, {"text", spot.text}});
  }
  if (!item.is_video) {
    if (!is_live) json["poster"] = poster_file(index);
    return json;
  }
  json["video"] = {{"fps", item.fps}};
  if (item.is_ambisonic) json["video"]["sound"] = "ambix";
  if (!item.subtitles.empty()) json["video"]["subtitles"] = item.subtitles;
  return json;
}

std::string view_json(std::span<const ViewItem> items, bool is_live, const Json& studio) {
  Json json = {{"items", Json::array()}, {"layouts", layouts()}, {"projections", projections()},
               {"tones", Json::array()}, {"live", is_live},      {"studio", studio}};
  for (const ToneCurve tone : kToneCurves) json["tones"].push_back(tone_curve_name(tone));
  for (size_t i = 0; i < items.size(); i++) json["items"].push_back(item_json(items[i], i, is_live));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

static std::string jpeg_of(const StoredPicture& picture, const ConvertTarget& target, const EyeOptions& options) {
  SaveOptions save;
  save.tone = picture.is_float ? options.tone : ToneCurve::kLinear;
  save.exposure = picture.is_float ? options.exposure : 0.0f;
  // Image libraries want a file. It is removed at once, by us or by whoever ends the process.
  static std::atomic<int> made{0};
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string path = (folder / fmt::format("ods-view-{}-{}.jpg", getpid(), made++)).string();
  const Conversion conversion = convert(picture, target);
  save_picture(conversion.rows, nullptr, save, path);
  const FileInput file(path);
  std::string bytes = file.read(0, file.size());
  std::filesystem::remove(path);
  return bytes;
}

std::string eye_jpeg(const StoredPicture& picture, int eye, const EyeOptions& options) {
  ConvertTarget target = same_format(picture);
  target.eyes = {eye};
  if (options.most_wide > 0 && target.eye.width > options.most_wide) {
    target.eye.height = std::max(target.eye.height * options.most_wide / target.eye.width, 1);
    target.eye.width = options.most_wide;
  }
  return jpeg_of(picture, target, options);
}

std::string poster_file(size_t index) {
  return fmt::format("item/{}/poster.jpg", index);
}

std::string poster_jpeg(const StoredPicture& picture) {
  ConvertTarget target = same_format(picture);
  target.camera.projection = find_projection("perspective")->setting;
  target.camera.projection.fov = 90.0f;
  target.eye = {960, 540};
  target.eyes = {kMono};
  if (picture.eyes.size() > 1) target.mono_from = picture.eyes[0].eye;
  return jpeg_of(picture, target, {});
}

}  // namespace ods
