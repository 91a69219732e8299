// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/view_item.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/base/decimal.h"
#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/camera/file_names.h"
#include "ods/convert/convert.h"
#include "ods/image/format/file_format.h"
#include "ods/image/small_rows.h"
#include "ods/video/container/video_file.h"
#include "ods/video/video_input.h"
#include "ods/view/camera_json.h"
#include "ods/view/formats.h"
#include "ods/view/layered_file.h"

namespace ods {

// Files that browsers decode, with each eye in a rectangle of its own.
static bool browsers_read(const std::string& path, const StoredPicture& picture) {
  const auto format = format_of_path(path);
  if (!picture.maps.empty()) return false;
  if (format != FileFormat::kPng && format != FileFormat::kJpeg && format != FileFormat::kWebp) return false;
  return picture.eyes.size() == 1 || arrangement_of(picture.layout).is_halves();
}

// Returns whether the sound track that browsers play is ambisonic, with the channels that the page supports
// (web/ambisonics.js).
static bool hears_around(const std::vector<SoundTrack>& sound) {
  if (sound.empty() || !sound[0].ambisonics) return false;
  return sound[0].ambisonics->channels == 4 && !sound[0].ambisonics->has_head_locked;
}

static bool has_vexu(const VideoFile& file) {
  return std::ranges::any_of(file.tracks, [](const VideoTrack& track) { return track.vexu.has_value(); });
}

// The picture that is shown outside the box, if there is one that browsers read.
static void open_fallback(const LayeredFile& file, ViewItem& item) {
  const std::string name =
      file.missing.empty() ? std::filesystem::path(file.fallback).filename().native() : file.missing;
  item.picture.eyes.emplace_back().eye = kMono;
  if (name.empty()) return;
  item.picture.guesses = {
      fmt::format("a layered scene without its picture '{}': there is none that browsers show", name)};
  if (file.fallback.empty()) return;
  try {
    OpenOptions options;
    options.color_only = true;
    StoredPicture picture = PictureReader(file.fallback, options).header();
    if (!browsers_read(file.fallback, picture)) return;
    item.picture = std::move(picture);
    item.picture.guesses.clear();
    item.fallback = file.fallback;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
  }
}

ViewItem open_view_item(const std::string& path, const FormatHint& known, std::optional<PictureReader> reader) {
  ViewItem item;
  item.path = path;
  item.known = known;
  item.name = std::filesystem::path(path).filename().string();
  item.notes = read_notes(path);
  if (is_layered_scene(path)) {
    item.kind = ItemKind::kLayers;
    item.has_own_file = true;
    const LayeredFile file = read_layered_file(path);
    item.scene = file.scene;
    item.ahead = file.ahead;
    open_fallback(file, item);
    return item;
  }
  if (!names_files(path) && is_video(path)) {
    const VideoInput video = open_video(path, known);
    if (!video.prototype.maps.empty()) {
      throw Error(ErrorKind::kInput,
                  fmt::format("cannot show '{}': it has fisheyes as its camera stored them, which browsers do not "
                              "unwrap: ods convert makes a video of it that they show",
                              path));
    }
    if (video.views == Views::kRows || video.views == Views::kColumns) {
      throw Error(ErrorKind::kInput,
                  fmt::format("cannot show '{}': its eyes are interleaved, which browsers do not take "
                              "apart: ods convert makes a video of it that they show",
                              path));
    }
    if (are_tracks(video.views)) {
      throw Error(ErrorKind::kInput,
                  fmt::format("cannot show '{}': its pictures are two tracks, of which browsers show one: ods convert "
                              "makes a video of it that they show",
                              path));
    }
    if (video.views != Views::kFirst) {
      throw Error(ErrorKind::kInput,
                  fmt::format("cannot show '{}': its eyes are layers of its stream (MV-HEVC), of which browsers show "
                              "one: ods convert makes a video of it that they show",
                              path));
    }
    item.kind = ItemKind::kVideo;
    item.has_own_file = true;
    item.picture = video.prototype;
    item.fps = video.fps;
    const VideoFile file = read_video_file(path);
    item.is_ambisonic = hears_around(file.sound);
    item.is_for_apple = has_vexu(file);
    item.subtitles = read_subtitles(path);
    return item;
  }
  OpenOptions options;
  options.format = known;
  options.color_only = true;
  if (!reader) reader.emplace(path, options);
  item.picture = reader->header();
  item.is_light = item.picture.is_float;
  item.is_for_apple = format_of_path(path) == FileFormat::kHeif && reader->info().is_pair;
  item.has_own_file = !names_files(path) && browsers_read(path, item.picture);
  if (!item.has_own_file && reader->is_decoded()) item.picture = reader->read("");
  return item;
}

std::string item_file(size_t index, std::string_view name) {
  return fmt::format("item/{}/{}", index, name);
}

std::vector<std::string> item_files(const ViewItem& item, size_t index) {
  if (item.has_own_file) {
    return {item_file(index, "picture" + std::filesystem::path(item.path).extension().string())};
  }
  std::vector<std::string> files;
  for (const StoredEye& eye : item.picture.eyes) {
    files.push_back(item_file(index, fmt::format("{}.jpg", eye_name(eye.eye))));
  }
  return files;
}

std::string system_file(const ViewItem& item, size_t index) {
  if (item.has_own_file) return item_files(item, index)[0];
  return item_file(index, "original" + std::filesystem::path(item.path).extension().string());
}

std::string fallback_file(const ViewItem& item, size_t index) {
  return item_file(index, "fallback" + std::filesystem::path(item.fallback).extension().string());
}

std::string object_file(size_t index, size_t object) {
  return item_file(index, fmt::format("object-{}.glb", object));
}

bool has_stills(const ViewItem& item) {
  return item.kind != ItemKind::kLayers || !item.fallback.empty();
}

static const std::string& still_path(const ViewItem& item) {
  return item.kind == ItemKind::kLayers ? item.fallback : item.path;
}

// The layout of light_png(): the file's layout, if it is simple enough.
static Layout light_layout(const StoredPicture& picture) {
  if (picture.eyes.size() == 1) return Layout::kSeparate;
  return arrangement_of(picture.layout).is_halves() ? picture.layout : Layout::kTopBottom;
}

bool has_light(const ViewItem& item) {
  constexpr int kLargest = 8192;  // pixels that every GPU with WebGL 2 takes, nearly
  if (!item.is_light || !item.picture.maps.empty()) return false;
  const int eyes = static_cast<int>(item.picture.eyes.size());
  const Extent size = packed_size(light_layout(item.picture), item.picture.size, eyes);
  return 2 * size.width <= kLargest && size.height <= kLargest;
}

// Only JPEG can be previewed early; other formats must be decoded in full first.
bool has_preview(const ViewItem& item, bool is_live) {
  if (item.kind != ItemKind::kPicture || !item.has_own_file || item.picture.size.width < 2 * kPreviewWidth)
    return false;
  return !is_live || format_of_path(item.path) == FileFormat::kJpeg;
}

static Json objects_json(const ViewItem& item, size_t index) {
  Json json = Json::array();
  for (size_t i = 0; i < item.objects.size(); i++) {
    const auto& [placement, name, glb] = item.objects[i];
    json.push_back({{"file", object_file(index, i)},
                    {"name", name},
                    {"path", placement.file},
                    {"at", {decimal(placement.at.x), decimal(placement.at.y), decimal(placement.at.z)}},
                    {"turn", decimal(placement.turn)}});
  }
  return json;
}

static Json item_json(const ViewItem& item, size_t index, bool is_live) {
  const std::vector<std::string> files = item_files(item, index);
  const bool is_mono = item.picture.eyes.size() == 1 || item.picture.front_and_back;
  Json json = {{"name", item.name}, {"kind", name_in(kItemKindTable, item.kind)}};
  if (!item.title.empty()) json["title"] = item.title;
  if (item.has_own_file) {
    json["image"] = files[0];
  } else {
    json["left"] = files.front();
    json["right"] = files.back();
  }
  if (item.is_for_apple) json["system"] = system_file(item, index);
  if (item.kind == ItemKind::kLayers) {
    json["fallback"] = item.fallback.empty() ? Json() : Json(fallback_file(item, index));
    if (!item.scene.empty()) json["scene"] = item.scene;
  }
  if (item.kind == ItemKind::kLayers || item.stage) json["objects"] = objects_json(item, index);
  if (item.stage) json["stage"] = stage_json(*item.stage, item.picture.camera, item_file(index, kDepthFile));
  if (has_stills(item)) json["thumbnail"] = item_file(index, kThumbnailFile);
  if (has_preview(item, is_live)) json["preview"] = item_file(index, kPreviewFile);
  json["layout"] = is_mono ? "mono" : layout_name(item.picture.layout);
  json["layout_reason"] = item.picture.layout_reason;
  json["projection"] = projection_name(item.picture.camera.projection);
  json["camera"] = camera_json(make_camera(item.picture.camera), item.stage != nullptr);
  json["size"] = {item.picture.size.width, item.picture.size.height};
  json["notes"] = item.picture.guesses;
  json["live"] = item.is_light;
  if (has_light(item)) {
    json["light"] = item_file(index, kLightFile);
    json["light_layout"] = is_mono ? "mono" : layout_name(light_layout(item.picture));
  }
  if (item.is_light) json["exposure"] = 0, json["tone"] = tone_curve_name(ToneCurve::kNeutral);
  if (!item.notes.caption.empty()) json["caption"] = item.notes.caption;
  for (const Hotspot& spot : item.notes.hotspots) {
    json["hotspots"].push_back({{"yaw", spot.yaw},
                                {"pitch", spot.pitch},
                                {"distance", decimal(spot.distance)},
                                {"title", spot.title},
                                {"text", spot.text}});
  }
  if (!is_live && has_stills(item)) json["poster"] = item_file(index, kPosterFile);
  if (item.kind != ItemKind::kVideo) return json;
  json["video"] = {{"fps", item.fps}};
  if (item.is_ambisonic) json["video"]["sound"] = "ambix";
  if (!item.subtitles.empty()) json["video"]["subtitles"] = item.subtitles;
  return json;
}

void add_tour(const Tour& tour, std::span<ViewItem> items) {
  for (size_t i = 0; i < items.size(); i++) {
    const TourStop& stop = tour.panoramas[i];
    items[i].title = stop.title;
    if (!stop.text.empty()) items[i].notes.caption = stop.text;
    items[i].notes.hotspots.insert(items[i].notes.hotspots.end(), stop.hotspots.begin(), stop.hotspots.end());
  }
}

std::string view_json(std::span<const ViewItem> items, bool is_live, const Json& studio, const Tour* tour) {
  Json json = {{"items", Json::array()}, {"live", is_live}, {"studio", studio}};
  if (tour) json["tour"] = tour_json(*tour);
  for (size_t i = 0; i < items.size(); i++) json["items"].push_back(item_json(items[i], i, is_live));
  return json_document(json);
}

static std::string file_of(const std::string& name, FileHeader header, Extent size, const RowSource& rows) {
  header.width = size.width, header.height = size.height;
  header.channels = {{"R"}, {"G"}, {"B"}};
  return image_bytes(name, header, rows);
}

static std::string jpeg_of(const StoredPicture& picture, const ConvertTarget& target, const EyeOptions& options) {
  SaveOptions save;
  save.tone = picture.is_float ? options.tone : ToneCurve::kLinear;
  save.exposure = picture.is_float ? options.exposure : 0.0f;
  const Conversion conversion = convert(picture, target);
  return eye_bytes(conversion.rows, 0, FileFormat::kJpeg, save);
}

// Means of the file's code values over whole pixels; `part`: 0..1 of the file, x, y, width, height.
static Image small_image(const std::string& path, int width, const std::array<double, 4>& part) {
  const std::unique_ptr<RowReader> rows =
      open_small_rows(path, static_cast<int>(std::ceil(static_cast<double>(width) / part[2])));
  const FileInfo& info = rows->info();
  const auto pixels = [](double share, int of) { return static_cast<int>(std::lround(share * of)); };
  const int left = pixels(part[0], info.width), top = pixels(part[1], info.height);
  const int wide = std::max(pixels(part[2], info.width), 1), high = std::max(pixels(part[3], info.height), 1);
  const int divide = std::max(wide / width, 1);
  Image image(std::max(wide / divide, 1), std::max(high / divide, 1), 3);
  const bool is_grey = info.channels.size() < 3;
  const size_t channels = is_grey ? 1 : 3, sample = bytes_of(info.samples[0]);
  const size_t row = static_cast<size_t>(info.width) * channels * sample;
  std::vector<std::byte> band(row * static_cast<size_t>(rows->band_rows()));
  for (int begin = 0; begin < std::min(info.height, top + high); begin += rows->band_rows()) {
    const int end = std::min(begin + rows->band_rows(), info.height);
    rows->read(begin, end, channels, band.data());
    for (int y = std::max(begin, top); y < std::min(end, top + image.height * divide); y++) {
      for (int x = 0; x < image.width * divide; x++) {
        const std::byte* const from = band.data() + row * static_cast<size_t>(y - begin) +
                                      static_cast<size_t>(std::min(left + x, info.width - 1)) * channels * sample;
        for (size_t c = 0; c < 3; c++) {
          image.at(x / divide, (y - top) / divide)[c] +=
              sample_value(info.samples[0], from + (is_grey ? 0 : c * sample));
        }
      }
    }
  }
  for (float& value : image.pixels) value /= static_cast<float>(divide * divide);
  return image;
}

static std::string small_jpeg(const std::string& path, int width, const std::array<double, 4>& part) {
  const Image image = small_image(path, width, part);
  FileHeader header;
  header.format = FileFormat::kJpeg;
  header.quality = 85;
  return file_of(path, header, {image.width, image.height},
                 [&](int y, std::span<float> row) { std::copy_n(image.at(0, y), row.size(), row.data()); });
}

std::string light_png(const StoredPicture& picture) {
  const Conversion conversion = convert(picture, same_format(picture));
  const PictureRows& rows = conversion.rows;
  const int count = static_cast<int>(rows.eyes.size());
  const Layout layout = light_layout(picture);
  const Extent whole = packed_size(layout, rows.eye, count);
  const size_t width = static_cast<size_t>(whole.width), channels = count_channels(rows.layers);
  FileHeader header;
  header.format = FileFormat::kPng;
  return file_of("the light", header, {2 * whole.width, whole.height}, [&](int y, std::span<float> row) {
    std::vector<float> pixels(static_cast<size_t>(rows.eye.width) * channels);
    for (int i = 0; i < count; i++) {
      const EyeCorner corner = count == 1 ? EyeCorner() : eye_corner(layout, rows.eye, i);
      if (y < corner.y || y >= corner.y + rows.eye.height) continue;
      rows.fill(i, y - corner.y, pixels);
      for (size_t x = 0; x < static_cast<size_t>(rows.eye.width); x++) {
        std::array<uint16_t, 3> halves{};
        floats_to_halves({&pixels[x * channels], 3}, halves.data());
        float* const to = &row[3 * (static_cast<size_t>(corner.x) + x)];
        for (size_t c = 0; c < 3; c++) {
          to[c] = static_cast<float>(halves[c] >> 8) / 255.0f;
          to[3 * width + c] = static_cast<float>(halves[c] & 255) / 255.0f;
        }
      }
    }
  });
}

std::string preview_jpeg(const ViewItem& item) {
  const double eye = eye_part(item.picture.layout, static_cast<int>(item.picture.eyes.size()), 0)[2];
  return small_jpeg(item.path, static_cast<int>(std::lround(kPreviewWidth / eye)), {0.0, 0.0, 1.0, 1.0});
}

StoredPicture open_shown(const ViewItem& item) {
  if (item.kind == ItemKind::kVideo) {
    const VideoInput video = open_video(item.path, item.known);
    VideoDecoder decoder(video.path, video.track);
    const std::optional<DecodedFrame> frame = decoder.next();
    if (!frame) throw Error(ErrorKind::kInput, fmt::format("'{}' has no picture", item.path));
    return picture_of(video, decoder.stream(), *frame);
  }
  if (item.picture.memory) return item.picture;
  OpenOptions open;
  open.format = item.known;
  open.color_only = true;
  return open_picture(still_path(item), open);
}

std::string thumbnail_jpeg(const ViewItem& item) {
  if (item.has_own_file && item.kind != ItemKind::kVideo) {
    return small_jpeg(still_path(item), kThumbnailWidth,
                      eye_part(item.picture.layout, static_cast<int>(item.picture.eyes.size()), 0));
  }
  EyeOptions options;
  options.max_width = kThumbnailWidth;
  return eye_jpeg(open_shown(item), item.picture.eyes[0].eye, options);
}

std::string eye_jpeg(const StoredPicture& picture, int eye, const EyeOptions& options) {
  ConvertTarget target = same_format(picture);
  target.eyes = {eye};
  if (options.max_width > 0 && target.eye.width > options.max_width) {
    target.eye.height = std::max(target.eye.height * options.max_width / target.eye.width, 1);
    target.eye.width = options.max_width;
  }
  return jpeg_of(picture, target, options);
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
