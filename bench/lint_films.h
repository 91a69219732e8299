// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The films that lint_video_bench judges: shots in which the camera or an object moves, faults planted into them, and
// the variations of correct films.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/lint_plant.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image.h"
#include "ods/lint/lint.h"

// The view of both eyes of a correct camera in a scene, at any time.
class Shot {
 public:
  // The camera's motion in the scene; its position does not change if the scene is a picture.
  using Way = std::function<void(ods::StereoCamera& camera, double seconds)>;
  // A world by formula, or a picture of a built-in scene, that turns with the camera.
  using Ground = std::function<ods::Image(const ods::StereoCamera& camera, int eye)>;

  Shot(std::string its_name, Ground ground, Way way, bool has_ball)
      : name(std::move(its_name)), ground_(std::move(ground)), way_(std::move(way)), has_ball_(has_ball) {}

  // Linear light, as an eye sees it. Keeps the last pictures.
  ods::Image at(int eye, double seconds) const;

  std::string name;

 private:
  Ground ground_;
  Way way_;
  bool has_ball_;
  mutable std::map<std::pair<int, int64_t>, ods::Image> made_;  // by eye and microseconds
};
using Shots = std::vector<std::shared_ptr<const Shot>>;

Shots film_shots();

// The picture of an eye in a frame of a film.
struct Moment {
  size_t shot = 0;
  double seconds = 0.0;
};

// A film to be saved to a file.
struct Film {
  Shots shots;  // one after the other, of equal length
  int frames = 60;
  double fps = 30.0;
  double speed = 1.0;  // speed of all motions
  std::function<void(Moment& moment, int frame, int eye)> retime;
  std::vector<std::function<void(std::vector<ods::Image>& eyes, int frame)>> edits;
  int quality = 20;  // CRF
  ods::Layout layout = ods::Layout::kTopBottom;
  bool one_eye = false;
  std::string suffix = "_360_TB";

  int length() const { return (frames + static_cast<int>(shots.size()) - 1) / static_cast<int>(shots.size()); }
  Moment moment(int frame) const { return {static_cast<size_t>(frame / length()), speed * frame / fps}; }
};

// Encodes it and returns its path.
std::string save(const Film& film, const std::string& stem);

struct FilmPlant : Plant<Film> {
  size_t shots = 1;  // number per film
  // The text required in the evidence of a fault of time, or the shot that must show a fault of pictures. May be empty.
  std::function<std::string(double strength)> evidence = {};
  int shot = -1;
  int every = 20;  // one of this many frames is judged as a picture
};
const std::vector<FilmPlant>& film_faults();
const std::vector<FilmPlant>& correct_films();
