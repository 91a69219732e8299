// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods project: where world points fall in each eye's picture, and back.
#include "ods/kernel/camera/project.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/print.h"
#include "cli/options/camera_source.h"
#include "ods/base/quote.h"
#include "ods/camera/layout.h"

using ods::Camera, ods::Sidecar, ods::vec2, ods::vec3;

namespace {

constexpr const char* kProjectExamples =
    "  ods project 0,1.5,-2 1,0,-3 --width 4096 --position 0,1.6,0\n"
    "  ods project --camera-file picture.camera.json --json < points.txt\n"
    "  ods project --camera-file picture.camera.json --from-pixel left,2048.5,1024.5,3.2";

// Pixels are counted from the left and top edge of the eye's own picture: the middle of the first is 0.5.
struct Found {
  int eye;
  vec2 uv;
  vec2 pixel;
  float depth;
  bool seen;
};

std::vector<Found> find(const Sidecar& file, const Camera& camera, vec3 point) {
  std::vector<Found> all;
  for (const int eye : file.eyes) {
    const ods::ImagePosition at = project_point(camera, eye, point);
    const vec2 size(static_cast<float>(file.eye.width), static_cast<float>(file.eye.height));
    all.push_back({eye, at.uv, at.uv * size, at.depth, at.seen});
  }
  return all;
}

void print_text(vec3 point, const std::vector<Found>& all) {
  for (const Found& f : all) {
    const std::string where = f.seen ? fmt::format("pixel {:.3f} {:.3f}  uv {:.7f} {:.7f}  depth {:.6g}", f.pixel.x,
                                                   f.pixel.y, f.uv.x, f.uv.y, f.depth)
                                     : "not seen: no ray of this eye meets it, or it is outside the picture";
    put_out(fmt::format("{:.6g},{:.6g},{:.6g}  {:5}  {}\n", point.x, point.y, point.z, ods::eye_name(f.eye), where));
  }
}

nlohmann::ordered_json to_json(vec3 point, const std::vector<Found>& all) {
  nlohmann::ordered_json json = {{"point", {point.x, point.y, point.z}}};
  for (const Found& f : all) {
    nlohmann::ordered_json& eye = json[std::string(ods::eye_name(f.eye))];
    eye["seen"] = f.seen;
    if (!f.seen) continue;
    eye["pixel"] = {f.pixel.x, f.pixel.y};
    eye["uv"] = {f.uv.x, f.uv.y};
    eye["depth"] = f.depth;
  }
  return json;
}

// EYE,X,Y,DEPTH -> the point of the world.
void print_point_of(const std::string& word, const Sidecar& file, const Camera& camera, bool json) {
  const size_t comma = std::min(word.find(','), word.size());
  const std::vector<float> n = comma < word.size() ? parse_numbers(word.substr(comma + 1)) : std::vector<float>();
  int eye = -1;
  for (const int each : {ods::kLeft, ods::kRight, ods::kMono}) {
    if (word.substr(0, comma) == ods::eye_name(each)) eye = each;
  }
  const bool legal =
      eye >= 0 && n.size() == 3 && std::isfinite(n[0]) && std::isfinite(n[1]) && n[2] > 0.0f && std::isfinite(n[2]);
  if (!legal) throw UsageError("--from-pixel is EYE,X,Y,DEPTH, as left,2048.5,1024.5,3.2, not '" + word + "'");
  const vec2 uv(n[0] / static_cast<float>(file.eye.width), n[1] / static_cast<float>(file.eye.height));
  const ods::Ray ray = camera_ray(camera, eye, uv);
  if (!ods::inside_picture(uv) || ray.direction == vec3(0.0f)) {
    throw UsageError(fmt::format("--from-pixel {}: outside the picture, which has {}x{} pixels", word, file.eye.width,
                                 file.eye.height));
  }
  const vec3 p = ray.origin + n[2] * ray.direction;
  if (json) {
    put_out(ods::json_document({{"point", {p.x, p.y, p.z}}}) + "\n");
  } else {
    put_out(fmt::format("{:.7g},{:.7g},{:.7g}\n", p.x, p.y, p.z));
  }
}

struct ProjectJob {
  CameraSource source;
  std::vector<std::string> points;  // X,Y,Z each; none: lines of stdin
  std::string pixel;                // EYE,X,Y,DEPTH, to be unprojected; empty: none
  bool json = false;
};

ProjectJob parse_project(Options& options) {
  ProjectJob job;
  options.describe(
      "Projects world points into each eye's picture. It reads no scene, so hidden points are projected, too.",
      kProjectExamples);
  options.arguments("X,Y,Z...", job.points, "points, in metres; without any, reads lines from stdin");
  options.text("--from-pixel", "EYE,X,Y,DEPTH", job.pixel, "unproject: the point at that depth along the pixel's ray");
  options.flag("--json", job.json, "print JSON, one object per line");
  add_camera_source(options, job.source);
  options.group("Console");
  add_console_options(options);
  options.parse();
  return job;
}

void project(const ProjectJob& job) {
  CameraSource source = job.source;
  const Sidecar file = read_camera_source(source);
  const Camera camera = make_camera(file.camera);
  const auto print = [&](std::string word) {
    std::replace_if(
        word.begin(), word.end(), [](char c) { return c == ' ' || c == '\t'; }, ',');
    const vec3 point = parse_point("a point", word);
    const std::vector<Found> all = find(file, camera, point);
    if (job.json) {
      put_out(ods::json_document(to_json(point, all)) + "\n");
    } else {
      print_text(point, all);
    }
  };
  if (!job.pixel.empty()) print_point_of(job.pixel, file, camera, job.json);
  for (const std::string& word : job.points) print(word);
  if (!job.points.empty() || !job.pixel.empty()) return;
  if (isatty(STDIN_FILENO)) throw UsageError("which points? ods project X,Y,Z, or lines of X,Y,Z on stdin");
  for (std::string line; std::getline(std::cin, line);) {
    if (!line.empty()) print(line);
  }
}

}  // namespace

extern const Command kProject =
    make_command<parse_project, project>("project", "project world points into each eye's picture");
