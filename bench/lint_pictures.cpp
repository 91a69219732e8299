// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/lint_pictures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "bench/subjects.h"
#include "ods/image/tone.h"
#include "ods/render/cpu/render.h"

using namespace ods;

// --- scenes --------------------------------------------------------------------------------------------------------

namespace {

constexpr int kWidth = 2048;

struct View {
  Subject subject;
  std::string name;
  vec3 offset{0.0f};  // from the scene's own position
  std::function<void(StereoCamera&)> camera = {};
};

std::vector<View> all_views() {
  const auto none = [](StereoCamera& camera) { camera.top = camera.bottom = PoleMergeSetting(); };
  const auto toe_in = [](StereoCamera& camera) { camera.convergence = kToeIn, camera.convergence_distance = 4.0f; };
  std::vector<View> views;
  for (const char* name : {"room", "wineglass", "mirrors", "fractal", "toys", "axis"}) views.push_back({{name}, name});
  views.push_back({kAtrium, "atrium"});
  views.push_back({kHelmet, "helmet"});
  views.push_back({{"room"}, "room-aside", vec3(0.6f, 0.1f, 0.5f)});
  views.push_back({{"fractal"}, "fractal-high", vec3(0.3f, 1.2f, 0.0f)});
  views.push_back({kAtrium, "atrium-no-merge", vec3(2.0f, 0.0f, 0.5f), none});
  views.push_back({{"toys"}, "toys-toed-in", vec3(0.0f), toe_in});
  return views;
}

// Renders the view, unless the folder has it from an earlier run.
Pair make_view(const View& view, const std::string& folder) {
  const std::string path = folder + "/" + view.name + "_TB.png";
  const Scene scene = load(view.subject);
  StereoCamera camera = camera_of(view.subject, scene);
  camera.position += view.offset;
  camera.top = camera.bottom = kUsualMerge;
  if (view.camera) view.camera(camera);
  if (!std::filesystem::exists(path)) {
    RenderOptions options;
    options.width = kWidth;
    options.samples = 2;
    options.bounces = 1;
    options.layers = false;
    save_picture(render_cpu(scene, camera, options), {}, path);
  }
  Pair pair{view.name, open_picture(path)};
  pair.picture.camera = camera;
  return pair;
}

}  // namespace

std::vector<Pair> scene_pairs(const std::string& folder) {
  std::vector<Pair> pairs;
  for (const View& view : all_views()) pairs.push_back(make_view(view, folder));
  return pairs;
}

// --- pictures ------------------------------------------------------------------------------------------------------

Made make_pair(const Pair& pair, int width, int quality) {
  Made made;
  made.pair = &pair;
  made.target = same_format(pair.picture);
  made.target.eye = {width, width / 2};
  made.save.jpeg_quality = quality;
  made.save.tone = ToneCurve::kLinear;
  made.suffix = "_TB";
  return made;
}

std::string save(const Made& made, const std::string& stem) {
  const Conversion conversion = convert(made.pair->picture, made.target);
  const PictureRows& rows = conversion.rows;
  const int channels = static_cast<int>(count_channels(rows.layers));
  std::vector<Image> eyes;
  std::vector<float> row(static_cast<size_t>(rows.eye.width * channels));
  for (size_t i = 0; i < rows.eyes.size(); i++) {
    Image& eye = eyes.emplace_back(rows.eye.width, rows.eye.height, 3);
    for (int y = 0; y < rows.eye.height; y++) {
      rows.fill(static_cast<int>(i), y, row);
      for (int x = 0; x < rows.eye.width; x++) std::copy_n(&row[static_cast<size_t>(x * channels)], 3, eye.at(x, y));
    }
  }
  for (const auto& edit : made.edits) edit(eyes);
  Picture picture;
  for (size_t i = 0; i < eyes.size(); i++)
    picture.eyes.push_back({eyes.size() == 1 ? kMono : static_cast<int>(i), eyes[i], {}, {}, {}});
  if (eyes.size() == 2) picture.eyes[0].eye = kLeft, picture.eyes[1].eye = kRight;
  const std::string path = stem + made.suffix + made.extension;
  save_picture(picture, made.save, path);
  return path;
}

namespace {

float sign_of(const Made& made) {
  return made.seed % 2 == 0 ? 1.0f : -1.0f;
}

// A column of an image between two others, or beyond the last.
float at_column(const Image& image, double x, int y, int c) {
  const int left = static_cast<int>(std::floor(x));
  const float share = static_cast<float>(x - left);
  const auto value = [&](int column) { return image.at((column + image.width) % image.width, y)[c]; };
  return (1.0f - share) * value(left) + share * value(left + 1);
}

// Makes the picture cover this many turns, stretched to its old width.
Image covering(const Image& image, double turns) {
  Image result = image;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      for (int c = 0; c < 3; c++) result.at(x, y)[c] = at_column(image, (x + 0.5) * turns - 0.5, y, c);
    }
  }
  return result;
}

Image blurred(const Image& image, double sigma) {
  const int reach = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<float> kernel;
  float sum = 0.0f;
  for (int i = -reach; i <= reach; i++) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
    sum += kernel.back();
  }
  Image across = image, both = image;
  for (const bool down : {false, true}) {
    const Image& from = down ? across : image;
    Image& to = down ? both : across;
    for (int y = 0; y < image.height; y++) {
      for (int x = 0; x < image.width; x++) {
        for (int c = 0; c < 3; c++) {
          float light = 0.0f;
          for (int i = -reach; i <= reach; i++) {
            const int column = down ? x : (x + i + image.width) % image.width;
            const int row = down ? std::clamp(y + i, 0, image.height - 1) : y;
            light += kernel[static_cast<size_t>(i + reach)] * from.at(column, row)[c];
          }
          to.at(x, y)[c] = light / sum;
        }
      }
    }
  }
  return both;
}

// Resizes like an editor without support of seams: each pixel is the mean of nine points.
Image resized(const Image& image, double scale) {
  Image result(static_cast<int>(image.width * scale) / 2 * 2, static_cast<int>(image.height * scale), 3);
  for (int y = 0; y < result.height; y++) {
    for (int x = 0; x < result.width; x++) {
      const double middle = (x + 0.5) * image.width / result.width - 0.5;
      for (int i = 0; i < 9 * 3; i++) {
        const double column = std::clamp(middle + (i / 9 - 1) * 0.4, 0.0, image.width - 1.001);
        const int row = std::min(static_cast<int>(y / scale + (i / 3 % 3) * 0.4), image.height - 1);
        result.at(x, y)[i % 3] += at_column(image, column, row, i % 3) / 9.0f;
      }
    }
  }
  return result;
}

Image sharpened(const Image& image, float amount) {
  Image result = image;
  const Image soft = blurred(image, 1.0);
  for (size_t i = 0; i < result.pixels.size(); i++) result.pixels[i] += amount * (image.pixels[i] - soft.pixels[i]);
  return result;
}

// Adds grain as displayed, different for each eye.
void add_grain(std::vector<Image>& eyes, double deviation, uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<float> normal(0.0f, static_cast<float>(deviation));
  for (Image& eye : eyes) {
    for (float& light : eye.pixels) {
      light = srgb_decode(std::clamp(srgb_encode(std::clamp(light, 0.0f, 1.0f)) + normal(engine), 0.0f, 1.0f));
    }
  }
}

// A gradient like a clear sky, down to a horizon at this fraction of the height.
void cover_with_sky(Image& eye, double horizon) {
  const int rows = static_cast<int>(horizon * eye.height);
  for (int y = 0; y < rows; y++) {
    const float down = static_cast<float>(y) / static_cast<float>(rows);
    for (int x = 0; x < eye.width; x++) {
      const vec3 sky = mix(vec3(0.05f, 0.15f, 0.45f), vec3(0.5f, 0.65f, 0.8f), down * down);
      std::copy_n(&sky.x, 3, eye.at(x, y));
    }
  }
}

// The picture of a camera that is rolled by this many degrees.
Image tilted(const Image& image, double degrees) {
  EyeCorrection roll;
  roll.roll = static_cast<float>(degrees);
  Image result = image;
  const Projection sphere = make_projection({});
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height));
      const vec3 there = stored_direction(roll, look_of(sphere, uv, uv).direction);
      const vec2 at = place_of(sphere, there).uv * vec2(image.width, image.height) - 0.5f;
      const int row = std::clamp(static_cast<int>(std::floor(at.y)), 0, image.height - 2);
      const float share = std::clamp(at.y - static_cast<float>(row), 0.0f, 1.0f);
      for (int c = 0; c < 3; c++) {
        const double column = static_cast<double>(at.x);
        result.at(x, y)[c] =
            (1.0f - share) * at_column(image, column, row, c) + share * at_column(image, column, row + 1, c);
      }
    }
  }
  return result;
}

// Makes the brightest pixels white, up to this fraction of the sphere about the horizon.
void whiten(Image& eye, double share) {
  std::vector<float> brightest;
  for (int y = 0; y < eye.height; y++) {
    const float weight = std::cos(kPi * ((static_cast<float>(y) + 0.5f) / static_cast<float>(eye.height) - 0.5f));
    const int step = std::max(1, static_cast<int>(4.0f / std::max(weight, 0.02f)));
    for (int x = 0; x < eye.width; x += step) brightest.push_back(eye.at(x, y)[1]);
  }
  const auto limit =
      brightest.begin() + static_cast<ptrdiff_t>((1.0 - share) * static_cast<double>(brightest.size() - 1));
  std::nth_element(brightest.begin(), limit, brightest.end());
  for (size_t i = 0; i < eye.pixels.size(); i += 3) {
    if (eye.pixels[i + 1] >= *limit) std::fill_n(&eye.pixels[i], 3, 1.0f);
  }
}

void reduce_bits(Image& eye, double bits) {
  const float maximum = static_cast<float>(std::exp2(bits)) - 1.0f;
  for (float& light : eye.pixels)
    light = srgb_decode(std::round(srgb_encode(std::min(light, 1.0f)) * maximum) / maximum);
}

// Applies the same curve and colours to both eyes.
void grade(std::vector<Image>& eyes, vec3 gain, float gamma) {
  for (Image& eye : eyes) {
    for (size_t i = 0; i < eye.pixels.size(); i++) {
      eye.pixels[i] = std::min(1.0f, gain[static_cast<int>(i % 3)] * std::pow(std::max(eye.pixels[i], 0.0f), gamma));
    }
  }
}

void add_alignment_faults(std::vector<PicturePlant>& plants) {
  const std::vector<double> heights{0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.5, 5.0}, rolls{0.5, 1.0, 2.0, 5.0, 10.0};
  plants.push_back(
      {"vertical offset", {Fault::kVerticalOffset}, Check::kAlignment, "degrees", heights, [](Made& made, double s) {
         made.target.right.raise = sign_of(made) * static_cast<float>(s);
       }});
  plants.push_back(
      {"pitch of one eye", {Fault::kEyePitched}, Check::kAlignment, "degrees", heights, [](Made& made, double s) {
         made.target.right.pitch = sign_of(made) * static_cast<float>(s);
       }});
  plants.push_back(
      {"roll of one eye", {Fault::kEyeRolled}, Check::kAlignment, "degrees", rolls, [](Made& made, double s) {
         made.target.right.roll = sign_of(made) * static_cast<float>(s);
       }});
  plants.push_back(
      {"size of one eye",
       {Fault::kEyeMagnified},
       Check::kAlignment,
       "%",
       {0.5, 1.0, 2.0, 4.0},
       [](Made& made, double s) { made.target.right.zoom = 1.0f + sign_of(made) * static_cast<float>(0.01 * s); }});
}

void add_color_faults(std::vector<PicturePlant>& plants) {
  plants.push_back({"tint of one eye",
                    {Fault::kEyeTinted},
                    Check::kColors,
                    "%",
                    {2.0, 5.0, 10.0, 20.0, 30.0},
                    [](Made& made, double s) {
                      made.target.right.gain[static_cast<int>(made.seed / 2 % 3)] = static_cast<float>(1.0 - 0.01 * s);
                    }});
  plants.push_back(
      {"exposure of one eye",
       {Fault::kEyeBrighter},
       Check::kColors,
       "stops",
       {0.05, 0.1, 0.2, 0.5, 1.0},
       [](Made& made, double s) { made.target.right.gain = vec3(std::exp2(sign_of(made) * static_cast<float>(s))); }});
  plants.push_back(
      {"gamma of one eye",
       {Fault::kEyeGamma},
       Check::kColors,
       "",
       {1.03, 1.06, 1.1, 1.2, 1.4},
       [](Made& made, double s) { made.target.right.gamma = static_cast<float>(made.seed % 2 == 0 ? s : 1.0 / s); }});
}

void add_other_faults(std::vector<PicturePlant>& plants) {
  plants.push_back({"blur of one eye",
                    {Fault::kEyeBlurred},
                    Check::kSharpness,
                    "pixels",
                    {0.5, 1.0, 1.5, 2.0, 4.0},
                    [](Made& made, double s) {
                      made.edits.push_back([s](std::vector<Image>& eyes) { eyes[1] = blurred(eyes[1], s); });
                    }});
  for (const double way : {-1.0, 1.0}) {
    plants.push_back({way < 0.0 ? "seam cut" : "seam doubled",
                      {Fault::kRaggedSeam},
                      Check::kSeam,
                      "%",
                      {0.5, 1.0, 2.0, 3.0, 6.0, 12.0},
                      [way](Made& made, double s) {
                        made.edits.push_back([=](std::vector<Image>& eyes) {
                          for (Image& eye : eyes) eye = covering(eye, 1.0 + way * 0.01 * s);
                        });
                      }});
  }
}

void add_warnings(std::vector<PicturePlant>& plants) {
  plants.push_back({"tilt of both eyes",
                    {Fault::kNotLevel},
                    Check::kHorizon,
                    "degrees",
                    {1.0, 2.0, 5.0, 10.0},
                    [](Made& made, double s) {
                      made.edits.push_back([s](std::vector<Image>& eyes) {
                        for (Image& eye : eyes) eye = tilted(eye, s);
                      });
                    }});
  plants.push_back(
      {"dead pole", {Fault::kDeadPole}, Check::kDeadPoles, "degrees", {5.0, 10.0, 25.0}, [](Made& made, double s) {
         made.edits.push_back([s](std::vector<Image>& eyes) {
           for (Image& eye : eyes) {
             const int rows = static_cast<int>(s / 180.0 * eye.height);
             std::fill(eye.pixels.end() - 3 * rows * eye.width, eye.pixels.end(), 0.0f);
           }
         });
       }});
  plants.push_back({"highlights clipped over a part of the picture",
                    {Fault::kClipped},
                    Check::kHighlights,
                    "%",
                    {1.0, 3.0, 10.0},
                    [](Made& made, double s) {
                      made.edits.push_back([s](std::vector<Image>& eyes) {
                        for (Image& eye : eyes) whiten(eye, 0.01 * s);
                      });
                    }});
  plants.push_back(
      {"sky of few bits", {Fault::kBanding}, Check::kBanding, "bits", {6.0, 5.0, 4.0}, [](Made& made, double s) {
         made.edits.push_back([s](std::vector<Image>& eyes) {
           for (Image& eye : eyes) {
             cover_with_sky(eye, 0.45);
             reduce_bits(eye, s);
           }
         });
       }});
}

// The faults that a wrong layout may appear as: another layout, two places instead of two eyes, or eyes of a wrong
// aspect ratio.
const std::vector<Fault> kWrongLayout = {Fault::kLayoutMisread, Fault::kMetadata, Fault::kMonoAsStereo,
                                         Fault::kWrongAspect};

void add_layout_faults(std::vector<PicturePlant>& plants) {
  plants.push_back(
      {"swapped eyes", {Fault::kEyesSwapped, Fault::kRightOnTop}, Check::kEyeOrder, "", {1.0}, [](Made& made, double) {
         made.edits.push_back([](std::vector<Image>& eyes) { std::swap(eyes[0], eyes[1]); });
       }});
  plants.push_back({"one eye twice", {Fault::kOneEyeTwice}, Check::kTwoEyes, "", {1.0}, [](Made& made, double) {
                      made.edits.push_back([](std::vector<Image>& eyes) { eyes[1] = eyes[0]; });
                    }});
  plants.push_back({"side by side read as top-bottom", kWrongLayout, Check::kLayout, "", {1.0}, [](Made& made, double) {
                      made.save.layout = Layout::kSideBySide, made.lint.layout = Layout::kTopBottom;
                      made.suffix.clear();
                    }});
  plants.push_back({"top-bottom read as side by side", kWrongLayout, Check::kLayout, "", {1.0}, [](Made& made, double) {
                      made.lint.layout = Layout::kSideBySide, made.suffix.clear();
                    }});
  plants.push_back({"one eye named top-bottom", kWrongLayout, Check::kLayout, "", {1.0}, [](Made& made, double) {
                      made.target.eyes = {kMono};
                      made.target.mono_from = made.seed % 2 == 0 ? kLeft : kRight;
                    }});
}

using Edit = void (*)(std::vector<Image>& eyes, double strength, uint32_t seed);

PicturePlant correct_edit(const char* name, const std::vector<double>& strengths, Edit edit) {
  return {name, {}, Check::kLayout, "", strengths, [edit](Made& made, double s) {
            made.edits.push_back([=, seed = made.seed](std::vector<Image>& eyes) { edit(eyes, s, seed); });
          }};
}

void add_developed(std::vector<PicturePlant>& kinds) {
  kinds.push_back({"as rendered, of all JPEG qualities",
                   {},
                   Check::kLayout,
                   "",
                   {50.0, 70.0, 80.0, 90.0, 98.0},
                   [](Made& made, double s) { made.save.jpeg_quality = static_cast<int>(s); }});
  kinds.push_back(correct_edit("graded", {0.7, 0.9, 1.2, 1.5}, [](std::vector<Image>& eyes, double s, uint32_t) {
    grade(eyes, vec3(1.2f, 1.0f, 0.8f), static_cast<float>(s));
  }));
  kinds.push_back(correct_edit("noisy", {0.01, 0.02, 0.05, 0.1},
                               [](std::vector<Image>& eyes, double s, uint32_t seed) { add_grain(eyes, s, seed); }));
  kinds.push_back(correct_edit("night", {0.02, 0.05, 0.1}, [](std::vector<Image>& eyes, double s, uint32_t seed) {
    grade(eyes, vec3(static_cast<float>(s)), 1.0f);
    add_grain(eyes, 0.01, seed);
  }));
  kinds.push_back(correct_edit("overexposed", {2.0, 4.0, 8.0}, [](std::vector<Image>& eyes, double s, uint32_t) {
    grade(eyes, vec3(static_cast<float>(s)), 1.0f);
  }));
  kinds.push_back(correct_edit("blurred in both eyes", {1.0, 3.0}, [](std::vector<Image>& eyes, double s, uint32_t) {
    for (Image& eye : eyes) eye = blurred(eye, s);
  }));
  kinds.push_back(correct_edit("sharpened", {0.5, 1.0}, [](std::vector<Image>& eyes, double s, uint32_t) {
    for (Image& eye : eyes) eye = sharpened(eye, static_cast<float>(s));
  }));
  kinds.push_back(correct_edit("resized by an editor", {0.7, 1.4}, [](std::vector<Image>& eyes, double s, uint32_t) {
    for (Image& eye : eyes) eye = resized(eye, s);
  }));
  kinds.push_back({"WebP, of two qualities", {}, Check::kLayout, "", {60.0, 90.0}, [](Made& made, double s) {
                     made.extension = ".webp", made.save.jpeg_quality = static_cast<int>(s);
                   }});
  kinds.push_back(correct_edit("under a plain sky", {0.3, 0.5}, [](std::vector<Image>& eyes, double s, uint32_t) {
    for (Image& eye : eyes) cover_with_sky(eye, s);
  }));
}

void add_formed(std::vector<PicturePlant>& kinds) {
  kinds.push_back({"turned by yaw", {}, Check::kLayout, "", {30.0, 97.0, 180.0, 260.0}, [](Made& made, double s) {
                     made.target.camera.yaw += static_cast<float>(s);
                   }});
  kinds.push_back({"of other sizes", {}, Check::kLayout, "", {1536.0, 2048.0}, [](Made& made, double s) {
                     made.target.eye = {static_cast<int>(s), static_cast<int>(s) / 2};
                   }});
  kinds.push_back({"side by side and half height", {}, Check::kLayout, "", {0.0, 1.0}, [](Made& made, double s) {
                     made.save.layout = s > 0.0 ? Layout::kSideBySide : Layout::kTopBottomHalf;
                     made.suffix = s > 0.0 ? "_LR" : "_HTB";
                   }});
  kinds.push_back({"VR180", {}, Check::kLayout, "", {0.0, 90.0, 180.0}, [](Made& made, double s) {
                     become_vr180(made);
                     made.target.camera.yaw += static_cast<float>(s);
                   }});
  kinds.push_back({"cubes", {}, Check::kLayout, "", {0.0, 45.0}, [](Made& made, double s) {
                     made.target.camera.projection = find_projection("cube-3x2")->setting;
                     made.target.camera.yaw += static_cast<float>(s);
                     made.target.eye = {made.target.eye.width / 12 * 12, made.target.eye.width / 12 * 8};
                     made.suffix = "_cube-3x2_TB";
                   }});
}

}  // namespace

const std::vector<PicturePlant>& planted_faults() {
  static const std::vector<PicturePlant> plants = [] {
    std::vector<PicturePlant> made;
    add_alignment_faults(made);
    add_divergence(made);
    add_color_faults(made);
    add_other_faults(made);
    add_warnings(made);
    add_layout_faults(made);
    return made;
  }();
  return plants;
}

const std::vector<PicturePlant>& correct_kinds() {
  static const std::vector<PicturePlant> kinds = [] {
    std::vector<PicturePlant> made;
    add_developed(made);
    add_formed(made);
    return made;
  }();
  return kinds;
}
