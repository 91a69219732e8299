// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/video/probe_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/console/print.h"
#include "ods/base/json_reader.h"
#include "ods/base/text.h"
#include "ods/video/container/complete_metadata.h"
#include "ods/video/container/hls.h"

using ods::Json;
using ods::SphericalMetadata;

namespace {

void row(std::string_view name, const std::string& value) {
  put_out(fmt::format("{:<18} {}\n", name, ods::one_line(value)));
}

std::string said(const std::optional<SphericalMetadata>& metadata) {
  if (!metadata) return "none";
  std::string text = metadata_text(*metadata);
  if (metadata->ipd > 0.0) text += fmt::format(", eyes {:g} mm apart", 1000.0 * metadata->ipd);
  return metadata->source.empty() ? text : fmt::format("{} (by {})", text, metadata->source);
}

bool is_matroska(const ods::VideoFile& video) {
  return video.container == ods::Container::kMatroska || video.container == ods::Container::kWebm;
}

std::string sound_text(const ods::SoundTrack& track) {
  if (!track.ambisonics) return fmt::format("track {}: {}", track.id, track.codec);
  return fmt::format("track {}: {}, ambisonics of order {}, {} channels{} (SA3D)", track.id, track.codec,
                     track.ambisonics->order, track.ambisonics->channels,
                     track.ambisonics->has_head_locked ? ", with head-locked stereo" : "");
}

// The line for a track with metadata.
std::optional<std::string> hls_line_of(const ods::VideoTrack& track) {
  const std::optional<SphericalMetadata> declared = ods::declared_metadata(track);
  return declared ? ods::hls_line(track, *declared) : std::nullopt;
}

void print_views(const ProbeReport& report, size_t index) {
  put_out(fmt::format("\nA player that\n"));
  for (const ods::PlayerView& view : report.views[index]) {
    put_out(fmt::format("{:<18} takes it for {}: {}\n", view.player == "ods" ? "is ods" : view.player,
                        ods::one_line(view.takes_it_for), ods::one_line(view.reason)));
  }
  if (!report.warnings[index].empty()) put_out(fmt::format("\n"));
  for (const std::string& warning : report.warnings[index])
    put_out(fmt::format("warning: {}\n", ods::one_line(warning)));
}

void print_video(const ProbeReport& report) {
  const ods::VideoFile& video = *report.video;
  row("container", fmt::format("{}{}", container_name(video.container), video.is_fragmented ? ", fragmented" : ""));
  for (const ods::SoundTrack& track : video.sound) row("sound", sound_text(track));
  for (size_t i = 0; i < video.tracks.size(); i++) {
    const ods::VideoTrack& track = video.tracks[i];
    std::string rate = track.fps > 0.0 ? fmt::format(", {:.5g} frames per second", track.fps) : "";
    row("pictures",
        fmt::format("track {}: {}, {}x{}{}", track.id, track.codec, track.size.width, track.size.height, rate));
    if (!is_matroska(video) || track.v1) row("Spherical Video V1", said(track.v1));
    row(is_matroska(video) ? "Projection, Stereo" : "Spherical Video V2", said(track.v2));
    if (!is_matroska(video)) row("Apple's vexu", said(track.vexu));
    if (const std::optional<std::string> line = hls_line_of(track)) row("HLS", *line);
    print_views(report, i);
  }
  if (video.tracks.empty()) row("pictures", "none");
  if (!report.joined.empty()) put_out("\n"), row("joined by ods", report.joined);
}

std::string camera_text(const ods::StereoCamera& stereo) {
  const glm::vec2 longitude = stereo.projection.longitude, latitude = stereo.projection.latitude;
  std::string text = fmt::format("{} {:.4g}x{:.4g} degrees", projection_name(stereo.projection),
                                 longitude.y - longitude.x, latitude.y - latitude.x);
  if (stereo.yaw != 0.0f || stereo.pitch != 0.0f || stereo.roll != 0.0f) {
    text += fmt::format(", yaw {:.6g}, pitch {:.6g}, roll {:.6g}", stereo.yaw, stereo.pitch, stereo.roll);
  }
  return text;
}

void print_picture(const ProbeReport& report) {
  const PictureReport& picture = *report.picture;
  row("picture", fmt::format("{}x{}, {}", picture.info.width, picture.info.height,
                             picture.info.is_float ? "light" : "display-encoded"));
  row("colour space", !picture.info.color.empty() ? picture.info.color : picture.info.is_float ? "none" : "none: sRGB");
  row("ods:projection", picture.info.text.contains("ods:projection") ? picture.info.text.at("ods:projection") : "none");
  if (!picture.info.is_float) row("GPano", picture.gpano ? camera_text(*picture.gpano) : "none");
  if (picture.info.is_float) row("envmap", picture.info.text.contains("textureformat") ? "lat-long" : "none");
  if (!picture.right_eye.empty()) row("embedded right eye", picture.right_eye);
  for (const std::string& guess : picture.format.guesses) row("guess", guess);
  print_views(report, 0);
}

Json to_json(const std::optional<SphericalMetadata>& metadata) {
  if (!metadata) return nullptr;
  Json json = {{"stereo", nullptr},         {"projection", nullptr},    {"bounds", metadata->bounds},
               {"yaw", metadata->yaw},      {"pitch", metadata->pitch}, {"roll", metadata->roll},
               {"source", metadata->source}};
  if (metadata->stereo) json["stereo"] = stereo_name(*metadata->stereo);
  if (metadata->projection) json["projection"] = projection_name(*metadata->projection);
  if (metadata->ipd > 0.0) json["ipd"] = metadata->ipd;
  return json;
}

// The possible readings of the pixels; null if metadata or name decide.
Json readings_to_json(const std::optional<ods::Identity>& identity) {
  if (!identity) return nullptr;
  Json json = Json::array();
  for (const ods::Reading& reading : identity->readings) {
    if (reading.certainty < 0.01) continue;
    json.push_back(
        {{"layout", nullptr}, {"projection", projection_name(reading.projection)}, {"certainty", reading.certainty}});
    if (reading.layout) json.back()["layout"] = layout_name(*reading.layout);
  }
  return json;
}

Json views_to_json(const ProbeReport& report, size_t index) {
  Json json = {{"readings", readings_to_json(report.seen[index])},
               {"players", Json::array()},
               {"warnings", report.warnings[index]}};
  for (const ods::PlayerView& view : report.views[index]) {
    json["players"].push_back({{"player", view.player}, {"takes_it_for", view.takes_it_for}, {"reason", view.reason}});
  }
  return json;
}

Json video_to_json(const ProbeReport& report) {
  const ods::VideoFile& video = *report.video;
  Json json = {{"container", container_name(video.container)},
               {"fragmented", video.is_fragmented},
               {"joined", nullptr},
               {"video", Json::array()},
               {"sound", Json::array()}};
  if (!report.joined.empty()) json["joined"] = report.joined;
  for (size_t i = 0; i < video.tracks.size(); i++) {
    const ods::VideoTrack& track = video.tracks[i];
    Json picture = {{"track", track.id},
                    {"codec", track.codec},
                    {"size", {track.size.width, track.size.height}},
                    {"fps", nullptr},
                    {"v1", to_json(track.v1)},
                    {"v2", to_json(track.v2)},
                    {"vexu", to_json(track.vexu)},
                    {"hls", nullptr}};
    if (const std::optional<std::string> line = hls_line_of(track)) picture["hls"] = *line;
    if (track.fps > 0.0) picture["fps"] = track.fps;
    picture.update(views_to_json(report, i));
    json["video"].push_back(picture);
  }
  for (const ods::SoundTrack& track : video.sound) {
    Json sound = {{"track", track.id}, {"codec", track.codec}, {"ambisonics", nullptr}};
    if (track.ambisonics) {
      sound["ambisonics"] = {{"order", track.ambisonics->order},
                             {"channels", track.ambisonics->channels},
                             {"head_locked", track.ambisonics->has_head_locked}};
    }
    json["sound"].push_back(sound);
  }
  return json;
}

Json picture_to_json(const ProbeReport& report) {
  const PictureReport& picture = *report.picture;
  Json json = {{"size", {picture.info.width, picture.info.height}},
               {"is_light", picture.info.is_float},
               {"color_space", picture.info.color},
               {"gpano", picture.gpano.has_value()},
               {"right_eye", nullptr},
               {"layout", nullptr},
               {"projection", projection_name(picture.format.camera.projection)},
               {"reason", picture.format.layout.reason},
               {"guesses", picture.format.guesses}};
  if (!picture.right_eye.empty()) json["right_eye"] = picture.right_eye;
  if (picture.format.layout.layout) json["layout"] = layout_name(*picture.format.layout.layout);
  json.update(views_to_json(report, 0));
  return json;
}

}  // namespace

void print_text(const ProbeReport& report) {
  row("file", report.path);
  report.video ? print_video(report) : print_picture(report);
}

void print_json(const ProbeReport& report) {
  Json json = {{"path", report.path}};
  json[report.video ? "video" : "picture"] = report.video ? video_to_json(report) : picture_to_json(report);
  // File names need not be valid UTF-8.
  put_json(json);
}
