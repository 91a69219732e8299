// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/video/probe_report.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

using Json = nlohmann::ordered_json;
using ods::FilmForm;

namespace {

// What stands in a file may hold anything, also what a terminal would obey.
std::string printable(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < ' ' || c == 0x7f ? '.' : c;
  return text;
}

void row(std::string_view name, const std::string& value) {
  fmt::print("{:<18} {}\n", name, printable(value));
}

std::string said(const std::optional<FilmForm>& form) {
  if (!form) return "says nothing";
  std::string text = form_text(*form);
  if (form->ipd > 0.0) text += fmt::format(", eyes {:g} mm apart", 1000.0 * form->ipd);
  return form->source.empty() ? text : fmt::format("{} (by {})", text, form->source);
}

bool is_matroska(const ods::FilmInfo& film) {
  return film.container == ods::Container::kMatroska || film.container == ods::Container::kWebm;
}

std::string sound_text(const ods::SoundTrack& track) {
  if (!track.ambisonics) return fmt::format("track {}: {}", track.id, track.codec);
  return fmt::format("track {}: {}, ambisonics of order {}, {} channels{} (SA3D)", track.id, track.codec,
                     track.ambisonics->order, track.ambisonics->channels,
                     track.ambisonics->has_head_locked ? ", with head-locked stereo" : "");
}

void print_views(const ProbeReport& report, size_t index) {
  fmt::print("\nA player that\n");
  for (const ods::PlayerView& view : report.views[index]) {
    fmt::print("  {:<18} takes it for {}: {}\n", view.player == "ods" ? "is ods" : view.player,
               printable(view.takes_it_for), printable(view.because));
  }
  if (!report.warnings[index].empty()) fmt::print("\n");
  for (const std::string& warning : report.warnings[index]) fmt::print("warning: {}\n", printable(warning));
}

void print_film(const ProbeReport& report) {
  const ods::FilmInfo& film = *report.film;
  row("container", fmt::format("{}{}", container_name(film.container), film.is_fragmented ? ", in fragments" : ""));
  for (const ods::SoundTrack& track : film.sound) row("sound", sound_text(track));
  for (size_t i = 0; i < film.video.size(); i++) {
    const ods::VideoTrack& track = film.video[i];
    std::string rate = track.fps > 0.0 ? fmt::format(", {:.5g} pictures a second", track.fps) : "";
    row("pictures",
        fmt::format("track {}: {}, {}x{}{}", track.id, track.codec, track.size.width, track.size.height, rate));
    if (!is_matroska(film) || track.v1) row("Spherical Video V1", said(track.v1));
    row(is_matroska(film) ? "Projection, Stereo" : "Spherical Video V2", said(track.v2));
    if (!is_matroska(film)) row("Apple's vexu", said(track.vexu));
    print_views(report, i);
  }
  if (film.video.empty()) row("pictures", "none");
}

std::string camera_text(const ods::CameraRig& rig) {
  const glm::vec2 longitude = rig.projection.longitude, latitude = rig.projection.latitude;
  std::string text = fmt::format("{} {:.4g}x{:.4g} degrees", projection_name(rig.projection), longitude.y - longitude.x,
                                 latitude.y - latitude.x);
  if (rig.yaw != 0.0f || rig.pitch != 0.0f || rig.roll != 0.0f) {
    text += fmt::format(", yaw {:.6g}, pitch {:.6g}, roll {:.6g}", rig.yaw, rig.pitch, rig.roll);
  }
  return text;
}

void print_picture(const ProbeReport& report) {
  const PictureReport& picture = *report.picture;
  row("picture", fmt::format("{}x{}, {}", picture.info.width, picture.info.height,
                             picture.info.is_float ? "light" : "code values of a display"));
  row("colour space", !picture.info.color.empty() ? picture.info.color : picture.info.is_float ? "none" : "none: sRGB");
  row("ods:projection", picture.info.text.contains("ods:projection") ? picture.info.text.at("ods:projection") : "none");
  if (!picture.info.is_float) row("GPano", picture.gpano ? camera_text(*picture.gpano) : "none");
  if (picture.info.is_float) row("envmap", picture.info.text.contains("textureformat") ? "lat-long" : "none");
  if (!picture.right_eye.empty()) row("right eye in it", picture.right_eye);
  for (const std::string& guess : picture.form.guesses) row("guess", guess);
  print_views(report, 0);
}

Json to_json(const std::optional<FilmForm>& form) {
  if (!form) return nullptr;
  Json json = {{"stereo", nullptr},    {"projection", nullptr}, {"bounds", form->bounds}, {"yaw", form->yaw},
               {"pitch", form->pitch}, {"roll", form->roll},    {"source", form->source}};
  if (form->stereo) json["stereo"] = stereo_name(*form->stereo);
  if (form->projection) json["projection"] = projection_name(*form->projection);
  if (form->ipd > 0.0) json["ipd"] = form->ipd;
  return json;
}

Json views_to_json(const ProbeReport& report, size_t index) {
  Json json = {{"players", Json::array()}, {"warnings", report.warnings[index]}};
  for (const ods::PlayerView& view : report.views[index]) {
    json["players"].push_back(
        {{"player", view.player}, {"takes_it_for", view.takes_it_for}, {"because", view.because}});
  }
  return json;
}

Json film_to_json(const ProbeReport& report) {
  const ods::FilmInfo& film = *report.film;
  Json json = {{"container", container_name(film.container)},
               {"fragmented", film.is_fragmented},
               {"video", Json::array()},
               {"sound", Json::array()}};
  for (size_t i = 0; i < film.video.size(); i++) {
    const ods::VideoTrack& track = film.video[i];
    Json video = {{"track", track.id},
                  {"codec", track.codec},
                  {"size", {track.size.width, track.size.height}},
                  {"fps", nullptr},
                  {"v1", to_json(track.v1)},
                  {"v2", to_json(track.v2)},
                  {"vexu", to_json(track.vexu)}};
    if (track.fps > 0.0) video["fps"] = track.fps;
    video.update(views_to_json(report, i));
    json["video"].push_back(video);
  }
  for (const ods::SoundTrack& track : film.sound) {
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
               {"projection", projection_name(picture.form.camera.projection)},
               {"because", picture.form.layout.because},
               {"guesses", picture.form.guesses}};
  if (!picture.right_eye.empty()) json["right_eye"] = picture.right_eye;
  if (picture.form.layout.layout) json["layout"] = layout_name(*picture.form.layout.layout);
  json.update(views_to_json(report, 0));
  return json;
}

}  // namespace

void print_text(const ProbeReport& report) {
  row("file", report.path);
  report.film ? print_film(report) : print_picture(report);
}

void print_json(const ProbeReport& report) {
  Json json = {{"path", report.path}};
  json[report.film ? "film" : "picture"] = report.film ? film_to_json(report) : picture_to_json(report);
  // A file's name may be no UTF-8.
  std::puts(json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}
