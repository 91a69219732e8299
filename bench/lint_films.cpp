// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/lint_films.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ods/image/tone.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/video/encode.h"
#include "tests/support/worlds.h"

using namespace ods;

// --- shots ----------------------------------------------------------------------------------------------------

namespace {

constexpr Extent kEye{512, 256};
constexpr size_t kKept = 160;  // pictures per shot
constexpr float kBallRadius = 0.22f;

// A ball that swings in front of the viewer and bounces; its pattern shows its position.
vec3 ball_at(double seconds) {
  const double across = 1.7 * std::sin(1.3 * seconds + 0.6 * std::sin(3.1 * seconds));
  return vec3(glm::dvec3(across, -0.4 + 0.5 * std::abs(std::sin(3.7 * seconds)), -1.5 + 0.3 * std::sin(2.3 * seconds)));
}

void draw_ball(Image& image, const StereoCamera& stereo, int eye, vec3 ball) {
  const Camera camera = make_camera(stereo);
  const float near = (kBallRadius + 0.1f) / length(ball - camera.center);  // with parallax
  const float limit = std::asin(std::min(1.0f, near));
  tbb::parallel_for(0, image.height, [&](int y) {
    if (std::abs(std::asin(normalize(ball - camera.center).y) +
                 kPi * (static_cast<float>(y) / static_cast<float>(image.height) - 0.5f)) > limit)
      return;
    for (int x = 0; x < image.width; x++) {
      const vec2 whole(static_cast<float>(image.width), static_cast<float>(image.height));
      vec3 sum(0.0f);
      float covered = 0.0f;
      for (int i = 0; i < 4; i++) {
        const vec2 place(static_cast<float>(x) + 0.25f + 0.5f * static_cast<float>(i % 2),
                         static_cast<float>(y) + 0.25f + 0.5f * static_cast<float>(i / 2));
        const Ray ray = camera_ray(camera, eye, place / whole);
        const vec3 to = ball - ray.origin;
        const float along = dot(to, ray.direction), off = dot(to, to) - along * along;
        if (along < 0.0f || off > 1.2f * kBallRadius * kBallRadius) break;
        if (off > kBallRadius * kBallRadius) continue;
        const vec3 normal = (along - std::sqrt(kBallRadius * kBallRadius - off)) * ray.direction - to;
        const float light = 0.3f + 0.7f * std::max(0.0f, normal.y / kBallRadius);
        sum += light * vec3(0.9f, 0.25f, 0.2f) * (0.2f + noise_at(normal, 0.15f, 91)), covered += 0.25f;
      }
      for (int c = 0; c < 3; c++) image.at(x, y)[c] += 0.25f * sum[c] - covered * image.at(x, y)[c];
    }
  });
}

// A camera that turns sees the same picture, moved along its rows.
Image turned(const Image& image, double degrees) {
  Image result = image;
  const double columns = degrees / 360.0 * image.width, whole = std::floor(columns);
  const float share = static_cast<float>(columns - whole);
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const int left = ((x + static_cast<int>(whole)) % image.width + image.width) % image.width;
      const float *one = image.at(left, y), *other = image.at((left + 1) % image.width, y);
      for (int c = 0; c < 3; c++) result.at(x, y)[c] = (1.0f - share) * one[c] + share * other[c];
    }
  }
  return result;
}

Shot::Ground in_world(World world) {
  return [world](const StereoCamera& camera, int eye) { return seen_in(world, camera, eye, kEye); };
}

Shot::Ground turning(const std::array<Image, 2>& eyes) {
  return [eyes](const StereoCamera& camera, int eye) {
    return turned(eyes[static_cast<size_t>(eye == kRight)], static_cast<double>(camera.yaw));
  };
}

Shot::Ground of_picture(const char* builtin) {
  const Scene scene = find_builtin(builtin)->make();
  StereoCamera camera;
  camera.position = default_view(scene).position;
  camera.top = camera.bottom = kUsualMerge;
  RenderOptions options;
  options.width = kEye.width;
  options.samples = 8;
  options.bounces = 2;
  options.even_noise = false, options.layers = false;
  Picture picture = render_cpu(scene, camera, options);
  return turning({std::move(picture.eyes[0].radiance), std::move(picture.eyes[1].radiance)});
}

Shot::Ground world_picture(World world) {
  StereoCamera camera;
  camera.top = camera.bottom = kUsualMerge;
  return turning({seen_in(world, camera, kLeft, kEye), seen_in(world, camera, kRight, kEye)});
}

// --- camera motions --------------------------------------------------------------------------------------------

void stand(StereoCamera&, double) {}

void pan(StereoCamera& camera, double seconds) {
  camera.yaw = static_cast<float>(25.0 * seconds);
}

void look_about(StereoCamera& camera, double seconds) {
  camera.yaw = static_cast<float>(20.0 * std::sin(1.1 * seconds) + 4.0 * std::sin(4.3 * seconds + 1.0));
}

void walk(StereoCamera& camera, double seconds) {
  camera.position =
      vec3(glm::dvec3(0.03 * std::sin(6.0 * seconds), 0.03 * std::abs(std::sin(6.0 * seconds)), 0.8 - 0.7 * seconds));
  camera.yaw = static_cast<float>(5.0 * std::sin(1.7 * seconds));
}

}  // namespace

Image Shot::at(int eye, double seconds) const {
  if (made_.size() > kKept) made_.clear();
  const auto [found, is_new] = made_.try_emplace({eye, std::llround(1e6 * seconds)});
  if (!is_new) return found->second;
  StereoCamera camera;
  camera.top = camera.bottom = kUsualMerge;
  way_(camera, seconds);
  found->second = ground_(camera, eye);
  if (has_ball_) draw_ball(found->second, camera, eye, ball_at(seconds));
  return found->second;
}

Shots film_shots() {
  Shots shots;
  const auto add = [&](const char* name, const Shot::Ground& ground, const Shot::Way& way, bool has_ball) {
    shots.push_back(std::make_shared<Shot>(name, ground, way, has_ball));
  };
  add("a walk through the hall", in_world(World::kHall), walk, false);
  add("a ball in the field", world_picture(World::kField), stand, true);
  add("a pan in the cave", world_picture(World::kCave), pan, true);
  add("looking about in the room", of_picture("room"), look_about, false);
  add("a ball among the toys", of_picture("toys"), stand, true);
  add("looking about at the fractal", of_picture("fractal"), look_about, true);
  return shots;
}

// --- files -----------------------------------------------------------------------------------------------------------

static std::vector<Image> eyes_of(const Film& film, int frame) {
  std::vector<Image> eyes;
  for (const int eye : {kLeft, kRight}) {
    if (film.one_eye && eye == kRight) continue;
    Moment moment = film.moment(frame);
    if (film.retime) film.retime(moment, frame, eye);
    eyes.push_back(film.shots[moment.shot]->at(eye, moment.seconds));
  }
  for (const auto& edit : film.edits) edit(eyes, frame);
  return eyes;
}

static void fill(VideoFrame& frame, Layout layout, const std::vector<Image>& eyes) {
  const Extent size = frame.extent();
  const int count = static_cast<int>(eyes.size());
  const auto rows = [&](int y, std::span<float> row) {
    for (const EyeRow& part : packed_row(layout, kEye, count, y)) {
      const float* pixels = eyes[static_cast<size_t>(part.index)].at(0, part.y);
      for (int i = 0; i < 3 * kEye.width; i++) {
        row[static_cast<size_t>(i % 3 * size.width + part.x + i / 3)] = video_code(std::clamp(pixels[i], 0.0f, 1.0f));
      }
    }
  };
  put_ycbcr(rows, size, frame.planes());
}

std::string save(const Film& film, const std::string& stem) {
  const std::string path = stem + film.suffix + ".mp4";
  EncodeOptions options;
  options.encoder = "libx264", options.preset = "veryfast";
  options.packing.quality = film.quality;
  options.rate = {static_cast<int>(film.fps), 1};
  const Extent size = packed_size(film.layout, kEye, film.one_eye ? 1 : 2);
  AtomicFile file(path);
  VideoEncoder encoder(file, Container::kMp4, size, options);
  for (int i = 0; i < film.frames; i++) {
    const auto frame = std::make_shared<VideoFrame>(size, options.packing);
    fill(*frame, film.layout, eyes_of(film, i));
    encoder.add(frame, {i, 1});
  }
  encoder.finish();
  file.commit();
  return path;
}

// --- faults ----------------------------------------------------------------------------------------------------------

namespace {

// Raises the picture by this many degrees.
Image raised(const Image& image, double degrees) {
  Image result = image;
  const double rows = degrees / 180.0 * image.height;
  for (int y = 0; y < image.height; y++) {
    const double from = std::clamp(y + rows, 0.0, image.height - 1.001);
    const int row = static_cast<int>(from);
    const float share = static_cast<float>(from - row);
    for (int i = 0; i < 3 * image.width; i++) {
      result.at(0, y)[i] = (1.0f - share) * image.at(0, row)[i] + share * image.at(0, row + 1)[i];
    }
  }
  return result;
}

// Adds grain as displayed, different for each eye and frame.
void add_grain(std::vector<Image>& eyes, double deviation, int frame) {
  std::mt19937 engine(static_cast<uint32_t>(frame));
  std::normal_distribution<float> normal(0.0f, static_cast<float>(deviation));
  for (Image& eye : eyes) {
    for (float& light : eye.pixels) light = video_light(std::clamp(video_code(light) + normal(engine), 0.0f, 1.0f));
  }
}

void dim(std::vector<Image>& eyes, double share) {
  for (Image& eye : eyes) {
    for (float& light : eye.pixels) light = std::min(1.0f, light * static_cast<float>(share));
  }
}

void add_faults_of_time(std::vector<FilmPlant>& plants) {
  FilmPlant late{{"right eye late", {Fault::kEyeLate}, Check::kEyeTime, "frames", {1.0, 2.0, 3.0, 5.0}}};
  late.plant = [](Film& film, double s) {
    film.retime = [s, step = film.speed / film.fps](Moment& moment, int, int eye) {
      if (eye == kRight) moment.seconds -= s * step;
    };
  };
  late.evidence = [](double s) { return "seen " + std::to_string(static_cast<int>(s)) + " frames"; };
  plants.push_back(late);

  FilmPlant cuts{{"cuts of the right eye late", {Fault::kCutsDiffer}, Check::kCuts, "frames", {1.0, 2.0, 5.0}}, 3};
  cuts.plant = [](Film& film, double s) {
    film.retime = [s, length = film.length()](Moment& moment, int frame, int eye) {
      if (eye == kRight && frame >= length && frame % length < static_cast<int>(s)) moment.shot--;
    };
  };
  cuts.every = 7;
  plants.push_back(cuts);

  FilmPlant twice{{"a frame twice of every", {Fault::kDuplicateFrames}, Check::kDuplicates, "", {2.0, 5.0, 10.0}}};
  twice.plant = [](Film& film, double s) {
    film.retime = [s, step = film.speed / film.fps](Moment& moment, int frame, int) {
      if (frame % static_cast<int>(s) == 1) moment.seconds -= step;
    };
  };
  plants.push_back(twice);
}

void add_faults_of_a_shot(std::vector<FilmPlant>& plants) {
  const auto add = [&](const char* name, const std::vector<Fault>& faults, Check check, const char* unit,
                       const std::vector<double>& strengths, void (*edit)(std::vector<Image> & eyes, double s)) {
    FilmPlant plant{{name, faults, check, unit, strengths}, 3};
    plant.plant = [edit](Film& film, double s) {
      film.edits.push_back([=, length = film.length()](std::vector<Image>& eyes, int frame) {
        if (frame / length == 1) edit(eyes, s);
      });
    };
    plant.shot = 1, plant.every = 4;
    plants.push_back(plant);
  };
  add("eyes swapped in one shot of three", {Fault::kEyesSwapped, Fault::kRightOnTop}, Check::kEyeOrder, "", {1.0},
      [](std::vector<Image>& eyes, double) { std::swap(eyes[0], eyes[1]); });
  add("vertical offset in one shot of three", {Fault::kVerticalOffset}, Check::kAlignment, "degrees", {0.5, 1.0, 2.0},
      [](std::vector<Image>& eyes, double s) { eyes[1] = raised(eyes[1], s); });
  add("tint of one eye in one shot of three", {Fault::kEyeTinted}, Check::kColors, "%", {5.0, 10.0, 20.0},
      [](std::vector<Image>& eyes, double s) {
        for (size_t i = 0; i < eyes[1].pixels.size(); i += 3) eyes[1].pixels[i] *= static_cast<float>(1.0 - 0.01 * s);
      });
}

// Removes the last columns, and stretches the rest.
Image cut(const Image& image, double share) {
  Image result = image;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const double from = std::clamp((x + 0.5) * (1.0 - share) - 0.5, 0.0, image.width - 1.001);
      const int left = static_cast<int>(from);
      const float part = static_cast<float>(from - left);
      for (int c = 0; c < 3; c++) {
        result.at(x, y)[c] = (1.0f - part) * image.at(left, y)[c] + part * image.at(left + 1, y)[c];
      }
    }
  }
  return result;
}

void add_faults_of_all(std::vector<FilmPlant>& plants) {
  FilmPlant seam{{"columns missing at the seam", {Fault::kRaggedSeam}, Check::kSeam, "%", {1.0, 3.0, 6.0, 12.0}}};
  seam.plant = [](Film& film, double s) {
    film.edits.push_back([s](std::vector<Image>& eyes, int) {
      for (Image& eye : eyes) eye = cut(eye, 0.01 * s);
    });
  };
  plants.push_back(seam);
}

void add_wrong_words(std::vector<FilmPlant>& plants) {
  const auto add = [&](const char* name, void (*plant)(Film & film)) {
    FilmPlant words{{name,
                     {Fault::kLayoutMisread, Fault::kMetadata, Fault::kMonoAsStereo, Fault::kWrongAspect},
                     Check::kLayout,
                     "",
                     {1.0}}};
    words.plant = [plant](Film& film, double) { plant(film); };
    plants.push_back(words);
  };
  add("side by side named top-bottom", [](Film& film) { film.layout = Layout::kSideBySide; });
  add("top-bottom named side by side", [](Film& film) { film.suffix = "_360_LR"; });
  add("one eye named top-bottom", [](Film& film) { film.one_eye = true; });
}

// --- correct films ---------------------------------------------------------------------------------------------------

FilmPlant correct(const char* name, const std::vector<double>& strengths, size_t shots,
                  const std::function<void(Film& film, double strength)>& plant) {
  FilmPlant kind{{name, {}, Check::kLayout, "", strengths, plant}, shots};
  kind.every = 10;
  return kind;
}

void add_ways_to_film(std::vector<FilmPlant>& kinds) {
  kinds.push_back(
      correct("at 24, 30 and 60 frames a second", {24.0, 30.0, 60.0}, 1, [](Film& film, double s) { film.fps = s; }));
  kinds.push_back(correct("slow, fast", {0.2, 3.0}, 1, [](Film& film, double s) { film.speed = s; }));
  kinds.push_back(correct("nothing moves", {0.0}, 1, [](Film& film, double) { film.speed = 0.0; }));
  kinds.push_back(correct("three shots", {1.0}, 3, [](Film&, double) {}));
  kinds.push_back(
      correct("of low bit rate", {35.0, 45.0}, 1, [](Film& film, double s) { film.quality = static_cast<int>(s); }));
  kinds.push_back(correct("grain", {0.02, 0.05}, 1, [](Film& film, double s) {
    film.edits.push_back([s](std::vector<Image>& eyes, int frame) { add_grain(eyes, s, frame); });
  }));
}

void add_edited(std::vector<FilmPlant>& kinds) {
  kinds.push_back(correct("fades from black and to black", {12.0, 24.0}, 1, [](Film& film, double s) {
    film.edits.push_back([s, last = film.frames - 1](std::vector<Image>& eyes, int frame) {
      dim(eyes, std::min({1.0, frame / s, (last - frame) / s}));
    });
  }));
  kinds.push_back(correct("dissolves between shots", {6.0, 16.0}, 3, [](Film& film, double s) {
    film.edits.push_back(
        [s, shots = film.shots, fps = film.fps, length = film.length()](std::vector<Image>& eyes, int frame) {
          const size_t shot = static_cast<size_t>(frame / length);
          const double share = 1.0 - (length - frame % length) / (s + 1.0);
          if (shot + 1 == shots.size() || share <= 0.0) return;
          for (size_t eye = 0; eye < 2; eye++) {
            const Image next = shots[shot + 1]->at(eye == 0 ? kLeft : kRight, frame / fps);
            for (size_t i = 0; i < next.pixels.size(); i++) {
              eyes[eye].pixels[i] += static_cast<float>(share) * (next.pixels[i] - eyes[eye].pixels[i]);
            }
          }
        });
  }));
  kinds.push_back(correct("the last picture is held", {10.0, 30.0}, 1, [](Film& film, double s) {
    film.retime = [s, last = film.frames - 1 - static_cast<int>(s), step = 1.0 / film.fps](Moment& moment, int, int) {
      moment.seconds = std::min(moment.seconds, last * step);
    };
  }));
  kinds.push_back(correct("lightning", {1.0, 3.0}, 1, [](Film& film, double s) {
    film.edits.push_back([s](std::vector<Image>& eyes, int frame) {
      if (frame % 30 >= 20 && frame % 30 < 20 + static_cast<int>(s)) dim(eyes, 6.0);
    });
  }));
  kinds.push_back(correct("a lamp flickers", {0.2}, 1, [](Film& film, double s) {
    film.edits.push_back([s](std::vector<Image>& eyes, int frame) {
      std::mt19937 engine(static_cast<uint32_t>(frame));
      dim(eyes, 1.0 - s * static_cast<double>(engine() % 100) / 100.0);
    });
  }));
}

}  // namespace

const std::vector<FilmPlant>& film_faults() {
  static const std::vector<FilmPlant> plants = [] {
    std::vector<FilmPlant> made;
    add_faults_of_time(made);
    add_faults_of_a_shot(made);
    add_faults_of_all(made);
    add_wrong_words(made);
    return made;
  }();
  return plants;
}

const std::vector<FilmPlant>& correct_films() {
  static const std::vector<FilmPlant> kinds = [] {
    std::vector<FilmPlant> made;
    add_ways_to_film(made);
    add_edited(made);
    return made;
  }();
  return kinds;
}
