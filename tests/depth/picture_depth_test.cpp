// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth from files beside pictures: what files mean, mistakes, soft edges, the scale of a floor.
#include "ods/depth/picture_depth.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "ods/picture/save.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A street: pillars on a level floor 1.6 m below, under the sky.
float street_depth(vec3 d) {
  constexpr float kEyes = 1.6f, kPillar = 0.4f;
  float depth = d.y < 0.0f ? kEyes / -d.y : kFarDepth;
  for (int i = 0; i < 9; i++) {
    const float turn = 0.7f * static_cast<float>(i), away = 2.5f + 0.4f * static_cast<float>(i % 4);
    const vec2 middle(away * std::sin(turn), -away * std::cos(turn)), flat(d.x, d.z);
    const float a = dot(flat, flat), b = dot(flat, middle), c = dot(middle, middle) - kPillar * kPillar;
    const float square = b * b - a * c;
    if (!(square > 0.0f && b > 0.0f)) continue;
    const float t = (b - std::sqrt(square)) / a;
    if (t * d.y > -kEyes && t * d.y < 0.8f) depth = std::min(depth, t);
  }
  return depth;
}

// Pillars are red, all else is green: edges of colour where edges of depth are.
MadePicture street(Extent size, const std::vector<int>& eyes = {kMono}) {
  MadePicture made = make_picture(StereoCamera(), size, eyes);
  made.picture.is_float = true;
  const Camera camera = make_camera(made.picture.camera);
  add_colour(made, [&](int, vec2 uv, float* out) {
    const vec3 d = camera_ray(camera, kMono, uv).direction;
    const bool pillar = street_depth(d) < (d.y < 0.0f ? 0.99f * 1.6f / -d.y : 100.0f);
    out[0] = pillar ? 0.8f : 0.1f, out[1] = pillar ? 0.1f : 0.5f, out[2] = 0.2f;
  });
  return made;
}

DepthNumbers numbers(Extent size, const std::function<float(float depth)>& of_depth, int codes = 0) {
  DepthNumbers depth{Image(size.width, size.height, 1), codes, "depth.png"};
  const Camera camera = make_camera(StereoCamera());
  for (int i = 0; i < size.width * size.height; i++) {
    const vec2 uv((static_cast<float>(i % size.width) + 0.5f) / static_cast<float>(size.width),
                  (static_cast<float>(i / size.width) + 0.5f) / static_cast<float>(size.height));
    const float value = of_depth(street_depth(camera_ray(camera, kMono, uv).direction));
    depth.numbers.pixels[static_cast<size_t>(i)] =
        codes > 0 ? std::round(std::clamp(value, 0.0f, 1.0f) * static_cast<float>(codes)) / static_cast<float>(codes)
                  : value;
  }
  return depth;
}

float layer_at(const StoredPicture& picture, int x, int y, size_t eye = 0) {
  const LayerPixels& layer = picture.eyes[eye].layers.back();
  EXPECT_EQ(layer.channels, std::vector<std::string>{"Z"});
  float depth;
  std::memcpy(&depth, layer.first + y * layer.row_stride + x * layer.pixel_stride, sizeof depth);
  return depth;
}

std::string fault_of(const std::function<void()>& work, ErrorKind kind) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "no fault";
}

// --- files -----------------------------------------------------------------------------------------------------------

template <class T>
std::string bytes_of_numbers(const std::vector<T>& numbers, bool swapped = false) {
  std::string bytes;
  for (const T number : numbers) {
    std::string own(reinterpret_cast<const char*>(&number), sizeof number);
    if (swapped) std::reverse(own.begin(), own.end());
    bytes += own;
  }
  return bytes;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& bytes, bool columns = false) {
  std::string words =
      "{'descr': '" + type + "', 'fortran_order': " + (columns ? "True" : "False") + ", 'shape': (" + shape + "), }";
  words.resize(118, ' ');
  const uint16_t length = 118;
  return std::string("\x93NUMPY\x01\x00", 8) + bytes_of_numbers<uint16_t>({length}) + words + bytes;
}

TEST(DepthFile, ReadsPfmAndNumpy) {
  const TemporaryFolder folder;
  const std::vector<float> rows = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f}, columns = {1.0f, 4.0f, 2.0f, 5.0f, 3.0f, 6.0f};
  const std::vector<float> upwards = {4.0f, 5.0f, 6.0f, 1.0f, 2.0f, 3.0f};
  const std::vector<double> doubles(rows.begin(), rows.end());
  const std::pair<const char*, std::string> files[] = {
      {"a.pfm", "Pf\n3 2\n-1.0\n" + bytes_of_numbers(upwards)},
      {"b.pfm", "Pf 3 2 1\n" + bytes_of_numbers(upwards, true)},
      {"c.npy", npy("<f4", "2, 3", bytes_of_numbers(rows))},
      {"d.npy", npy(">f8", "1, 2, 3, 1", bytes_of_numbers(doubles, true))},
      {"e.npy", npy("<i4", "2, 3", bytes_of_numbers<int32_t>({1, 2, 3, 4, 5, 6}))},
      {"f.npy", npy("<f4", "2, 3", bytes_of_numbers(columns), true)},
      {"g.npy", npy("<f2", "2, 3", bytes_of_numbers<uint16_t>({0x3c00, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600}))}};
  for (const auto& [name, bytes] : files) {
    folder.write(name, bytes);
    const DepthNumbers depth = read_depth_numbers(folder.path(name));
    EXPECT_EQ(depth.numbers.width, 3) << name;
    EXPECT_EQ(depth.codes, 0) << name;
    EXPECT_EQ(depth.numbers.pixels, rows) << name;
  }
  folder.write("h.npy", npy("|u1", "2, 3", bytes_of_numbers<uint8_t>({0, 51, 102, 153, 204, 255})));
  const DepthNumbers codes = read_depth_numbers(folder.path("h.npy"));
  EXPECT_EQ(codes.codes, 255);
  EXPECT_FLOAT_EQ(codes.numbers.pixels[1], 0.2f);
}

TEST(DepthFile, ReadsPicturesAsTheirCodesWhateverTheirColours) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, FileFormat format, SampleType sample,
                         const std::vector<std::string>& channels) {
    AtomicFile file(folder.path(name));
    FileHeader header;
    header.format = format, header.width = 4, header.height = 2;
    for (const std::string& channel : channels) header.channels.push_back({channel, sample});
    write_image(file, header, [&](int y, std::span<float> row) {
      for (size_t i = 0; i < row.size(); i++) {
        row[i] = 0.1f * static_cast<float>(y) + 0.05f * static_cast<float>(i / channels.size());
      }
    });
    file.commit();
    return read_depth_numbers(folder.path(name));
  };
  const std::pair<DepthNumbers, int> all[] = {
      {write("a.png", FileFormat::kPng, SampleType::kUint16, {"Y"}), 65535},
      {write("b.tif", FileFormat::kTiff, SampleType::kUint16, {"R", "G", "B"}), 65535},
      {write("c.png", FileFormat::kPng, SampleType::kUint8, {"Y"}), 255},
      {write("d.exr", FileFormat::kExr, SampleType::kFloat, {"Z"}), 0},
      {write("e.exr", FileFormat::kExr, SampleType::kFloat, {"R", "G", "B", "Layer.Depth.Z"}), 0}};
  for (const auto& [depth, codes] : all) {
    EXPECT_EQ(depth.codes, codes) << depth.path;
    for (int i = 0; i < 8; i++) {
      EXPECT_NEAR(depth.numbers.pixels[static_cast<size_t>(i)],
                  0.1f * static_cast<float>(i / 4) + 0.05f * static_cast<float>(i % 4), 0.003f)
          << depth.path;
    }
  }
}

TEST(DepthFile, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  const std::pair<std::string, const char*> bad[] = {{"Pf\n3 2\n-1.0\nshort", "a.x"},
                                                     {"Pf\n-3 2\n-1.0\n", "a.x"},
                                                     {"Pf\n30000 30000\n-1.0\n", "a.x"},
                                                     {npy("<f4", "2, 3", "short"), "a.x"},
                                                     {npy("<c8", "2, 3", std::string(48, 'a')), "plain numbers"},
                                                     {npy("<f4", "2, 3, 4", std::string(96, 'a')), "3 axes"},
                                                     {npy("<f4", "999999, 3", std::string(96, 'a')), "a.x"},
                                                     {"\x93NUMPY", "a.x"},
                                                     {"P", "a.x"}};
  for (const auto& [bytes, words] : bad) {
    folder.write("a.x", bytes);
    EXPECT_NE(fault_of([&] { read_depth_numbers(folder.path("a.x")); }, ErrorKind::kInput).find(words),
              std::string::npos)
        << words;
  }
  Picture colorful;
  colorful.eyes.push_back({kMono, Image(8, 4, 3), {}, {}, {}});
  for (size_t i = 0; i < 32; i++) colorful.eyes[0].radiance.pixels[3 * i] = 1.0f;
  save_picture(colorful, SaveOptions(), folder.path("map.png"));
  EXPECT_NE(fault_of([&] { read_depth_numbers(folder.path("map.png")); }, ErrorKind::kInput).find("colours"),
            std::string::npos);
}

// --- meanings --------------------------------------------------------------------------------------------------------

TEST(PictureDepth, EveryKindMeansTheSame) {
  const Extent size{256, 128};
  struct Case {
    DepthKind kind;
    int codes;
    std::function<float(float)> number;  // of metres
    std::optional<float> near, far;
  };
  const auto limited = [](float metres) { return std::min(metres, 30.0f); };
  const Case cases[] = {
      {DepthKind::kMetres, 0, limited, {}, {}},
      {DepthKind::kMetres, 0, [](float m) { return m > 1e9f ? kInfinity : m; }, {}, {}},
      {DepthKind::kMillimetres, 65535, [&](float m) { return limited(m) / 65.535f; }, {}, {}},
      {DepthKind::kInverse, 0, [](float m) { return 1.0f / m; }, {}, {}},
      {DepthKind::kInverse, 65535, [](float m) { return (1.0f / m - 1.0f / 30.0f) / (1.0f - 1.0f / 30.0f); }, 1.0f,
       30.0f},
      {DepthKind::kDisparity, 65535, [](float m) { return 1.6f / m; }, 1.6f, {}},
      {DepthKind::kDisparity, 0, [](float m) { return 77.0f / m; }, 1.6f, {}},
      {DepthKind::kRelative, 65535, [&](float m) { return (limited(m) - 1.0f) / 29.0f; }, 1.0f, 30.0f}};
  for (const Case& one : cases) {
    MadePicture made = street(size);
    DepthOptions options;
    options.edges = DepthEdges::kSoft;
    options.format.kind = one.kind, options.format.nearest = one.near, options.format.farthest = one.far;
    const DepthReport report = add_depth(made.picture, {numbers(size, one.number, one.codes)}, options);
    EXPECT_TRUE(report.warnings.empty());
    const Camera camera = make_camera(made.picture.camera);
    int off = 0;
    float nearest = 1e9f;
    for (int i = 0; i < size.width * size.height; i++) {
      const vec2 uv((static_cast<float>(i % size.width) + 0.5f) / static_cast<float>(size.width),
                    (static_cast<float>(i / size.width) + 0.5f) / static_cast<float>(size.height));
      const float truth = street_depth(camera_ray(camera, kMono, uv).direction);
      const float own = layer_at(made.picture, i % size.width, i / size.width);
      nearest = std::min(nearest, own);
      if (truth < 29.0f) off += std::abs(own - truth) > 0.01f * truth;
      if (truth > 30.0f) off += own < 29.9f;
    }
    EXPECT_EQ(off, 0) << name_in(kDepthKindTable, one.kind) << " " << one.codes;
    EXPECT_NEAR(nearest, 1.6f, 0.02f);
  }
}

TEST(PictureDepth, AlongTheAxisOfALens) {
  StereoCamera window;
  window.projection = projection_named("perspective");
  window.projection.fov = 90.0f;
  MadePicture made = make_picture(window, {64, 64}, {kMono});
  add_colour(made, [](int, vec2, float* out) { out[0] = out[1] = out[2] = 0.5f; });
  DepthNumbers wall{Image(64, 64, 1), 0, "wall.exr"};
  for (size_t i = 0; i < wall.numbers.pixels.size(); i++) wall.numbers.pixels[i] = 2.0f + (i == 0 ? 1e-4f : 0.0f);
  DepthOptions options;
  options.format.along = DepthAlong::kAxis;
  add_depth(made.picture, {wall}, options);
  EXPECT_NEAR(layer_at(made.picture, 32, 32), 2.0f, 0.01f);
  EXPECT_NEAR(layer_at(made.picture, 63, 63), 2.0f * std::sqrt(3.0f), 0.05f);
  MadePicture sphere = street({64, 32});
  EXPECT_NE(fault_of(
                [&] {
                  add_depth(sphere.picture, {numbers({64, 32}, [](float m) { return m; })}, options);
                },
                ErrorKind::kUsage)
                .find("`depth-along`"),
            std::string::npos);
}

TEST(PictureDepth, OfBothEyes) {
  MadePicture made = street({64, 32}, {kLeft, kRight});
  made.picture.layout = Layout::kSideBySide;
  DepthNumbers both{Image(64, 16, 1), 0, "both.npy"};  // half as large, side by side
  for (int i = 0; i < 64 * 16; i++) {
    const int x = i % 64, y = i / 64;
    both.numbers.pixels[static_cast<size_t>(i)] = (x < 32 ? 2.0f : 4.0f) + 0.001f * static_cast<float>(y);
  }
  add_depth(made.picture, depth_of_eyes(both, made.picture), {});
  EXPECT_NEAR(layer_at(made.picture, 20, 1, 0), 2.0f, 0.05f);
  EXPECT_NEAR(layer_at(made.picture, 20, 1, 1), 4.0f, 0.05f);
  const DepthNumbers one{Image(64, 32, 1), 0, "one.npy"};
  EXPECT_NE(fault_of([&] { depth_of_eyes(one, made.picture); }, ErrorKind::kInput).find("two eyes"), std::string::npos);
}

// --- mistakes --------------------------------------------------------------------------------------------------------

TEST(PictureDepth, MistakesAreSaidInOneLine) {
  const Extent size{128, 64};
  const auto same = [](float m) { return std::min(m, 50.0f); };
  struct Case {
    const char* says;
    ErrorKind kind;
    DepthNumbers depth;
    DepthFormat format;
  };
  const auto filled = [&](float value) { return numbers(size, [value](float) { return value; }); };
  const DepthFormat inverse{DepthKind::kInverse, DepthAlong::kRay, {}, {}};
  const Case cases[] = {
      {"0 everywhere", ErrorKind::kInput, filled(0.0f), {}},
      {"3 everywhere", ErrorKind::kInput, filled(3.0f), {}},
      {"NaN", ErrorKind::kInput, filled(std::nanf("")), {}},
      {"infinite everywhere", ErrorKind::kInput, filled(kInfinity), {}},
      {"negative", ErrorKind::kInput, numbers(size, [&](float m) { return -same(m); }), {}},
      {"are 0", ErrorKind::kInput, numbers(size, [](float m) { return m < 2.0f ? m : 0.0f; }), {}},
      {"another shape", ErrorKind::kInput, numbers({128, 100}, same), {}},
      {"`depth-kind` to one of metres, millimetres", ErrorKind::kUsage, numbers(size, same, 255), {}},
      {"`near`", ErrorKind::kUsage,
       numbers(
           size, [](float m) { return 1.0f / m; }, 255),
       inverse},
      {"both ends", ErrorKind::kUsage, numbers(size, same), {DepthKind::kRelative, DepthAlong::kRay, 1.0f, {}}},
      {"nearer than `far`",
       ErrorKind::kUsage,
       numbers(size, same),
       {DepthKind::kRelative, DepthAlong::kRay, 5.0f, 2.0f}}};
  for (const Case& one : cases) {
    MadePicture made = street(size);
    DepthOptions options;
    options.format = one.format;
    const std::string fault = fault_of([&] { add_depth(made.picture, {one.depth}, options); }, one.kind);
    EXPECT_NE(fault.find(one.says), std::string::npos) << one.says << ": " << fault;
    EXPECT_NE(fault.find("depth.png"), std::string::npos) << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
  MadePicture made = street(size);
  const DepthReport report =
      add_depth(made.picture, {numbers(size, [&](float m) { return m < 1.7f ? std::nanf("") : same(m); })}, {});
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes[0].find("are not depths"), std::string::npos) << report.notes[0];
  EXPECT_EQ(layer_at(made.picture, 64, 63), kFarDepth);
}

TEST(PictureDepth, InvertedDepthIsNoticed) {
  const Extent size{512, 256};
  const auto warnings = [&](DepthKind kind, const std::function<float(float)>& number) {
    MadePicture made = street(size);
    DepthOptions options;
    options.format.kind = kind, options.format.nearest = 1.0f, options.format.farthest = 30.0f;
    return add_depth(made.picture, {numbers(size, number, 65535)}, options).warnings;
  };
  const auto by_metres = [](float m) { return (std::min(m, 30.0f) - 1.0f) / 29.0f; };
  const auto by_nearness = [](float m) { return 1.0f / m; };
  EXPECT_TRUE(warnings(DepthKind::kRelative, by_metres).empty());
  EXPECT_TRUE(warnings(DepthKind::kInverse, by_nearness).empty());
  const auto far_white = warnings(DepthKind::kInverse, by_metres);
  ASSERT_EQ(far_white.size(), 1u);
  EXPECT_NE(far_white[0].find("`depth-kind` relative"), std::string::npos) << far_white[0];
  const auto near_white = warnings(DepthKind::kRelative, by_nearness);
  ASSERT_EQ(near_white.size(), 1u);
  EXPECT_NE(near_white[0].find("`depth-kind` inverse"), std::string::npos) << near_white[0];
}

// --- scale -----------------------------------------------------------------------------------------------------------

TEST(PictureDepth, TheFloorGivesTheScale) {
  const Extent size{256, 128};
  DepthOptions options;
  options.format.kind = DepthKind::kDisparity;
  options.eye_height = 1.6f;
  // With a hundredth of noise.
  uint32_t state = 7;
  const auto noisy = [&](float m) {
    state = state * 1664525u + 1013904223u;
    return 123.0f / m * (1.0f + 0.02f * (static_cast<float>(state >> 8) / 16777216.0f - 0.5f));
  };
  MadePicture made = street(size);
  const DepthReport report = add_depth(made.picture, {numbers(size, noisy)}, options);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes[0].find("floor"), std::string::npos);
  EXPECT_NEAR(layer_at(made.picture, 128, 127), 1.6f, 0.03f);

  options.eye_height = 3.2f;
  MadePicture giant = street(size);
  add_depth(giant.picture, {numbers(size, noisy)}, options);
  EXPECT_NEAR(layer_at(giant.picture, 128, 127), 3.2f, 0.06f);

  // A bowl has no floor.
  DepthNumbers bowl{Image(256, 128, 1), 0, "bowl.npy"};
  for (size_t i = 0; i < bowl.numbers.pixels.size(); i++)
    bowl.numbers.pixels[i] = 1.0f + 0.001f * static_cast<float>(i % 7);
  const std::string fault = fault_of([&] { add_depth(giant.picture, {bowl}, options); }, ErrorKind::kInput);
  EXPECT_NE(fault.find("no level floor"), std::string::npos) << fault;
}

// --- edges -----------------------------------------------------------------------------------------------------------

Image blurred(const Image& image, int radius) {
  Image across = image, result = image;
  const auto mean = [&](const Image& from, int x, int y, int dx, int dy) {
    float sum = 0.0f;
    for (int i = -radius; i <= radius; i++) {
      sum += *from.at((x + i * dx + image.width) % image.width, std::clamp(y + i * dy, 0, image.height - 1));
    }
    return sum / static_cast<float>(2 * radius + 1);
  };
  for (int i = 0; i < image.width * image.height; i++) {
    *across.at(i % image.width, i / image.width) = mean(image, i % image.width, i / image.width, 1, 0);
  }
  for (int i = 0; i < image.width * image.height; i++) {
    *result.at(i % image.width, i / image.width) = mean(across, i % image.width, i / image.width, 0, 1);
  }
  return result;
}

// Pixels above the horizon, where the sky is behind the pillars, that are neither of the two.
int between_pillar_and_sky(const StoredPicture& picture, int& misplaced) {
  const Camera camera = make_camera(picture.camera);
  int between = 0;
  for (int y = picture.size.height * 3 / 8; y < picture.size.height / 2; y++) {
    for (int x = 0; x < picture.size.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(picture.size.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(picture.size.height));
      const bool pillar = street_depth(camera_ray(camera, kMono, uv).direction) < 100.0f;
      const float own = layer_at(picture, x, y);
      between += own > 4.5f && own < 50.0f;
      misplaced += pillar != (own < 10.0f);
    }
  }
  return between;
}

TEST(PictureDepth, SoftEdgesBecomeAsSharpAsThePictures) {
  const Extent size{512, 256};
  const auto inverse = [](float m) { return 1.0f / m; };
  DepthNumbers soft = numbers(size, inverse);
  soft.numbers = blurred(soft.numbers, 2);
  DepthOptions options;
  options.format.kind = DepthKind::kInverse;
  const auto measure = [&](const DepthNumbers& depth, DepthEdges edges, int& misplaced) {
    MadePicture made = street(size);
    options.edges = edges;
    add_depth(made.picture, {depth}, options);
    misplaced = 0;
    return between_pillar_and_sky(made.picture, misplaced);
  };
  int before = 0, after = 0;
  const int soft_between = measure(soft, DepthEdges::kSoft, before);
  const int sharp_between = measure(soft, DepthEdges::kSharp, after);
  EXPECT_GT(soft_between, 1000);
  EXPECT_LT(sharp_between, soft_between / 10);
  EXPECT_LT(after, before / 4);

  // A small map of a large picture has soft edges, too.
  const int small_between = measure(numbers({128, 64}, inverse), DepthEdges::kSharp, after);
  EXPECT_LT(small_between, soft_between / 10);

  // Exact depth stays as it is.
  MadePicture exact = street(size), untouched = street(size);
  options.edges = DepthEdges::kSharp;
  add_depth(exact.picture, {numbers(size, inverse)}, options);
  options.edges = DepthEdges::kSoft;
  add_depth(untouched.picture, {numbers(size, inverse)}, options);
  int changed = 0;
  for (int i = 0; i < size.width * size.height; i++) {
    changed += layer_at(exact.picture, i % 512, i / 512) != layer_at(untouched.picture, i % 512, i / 512);
  }
  EXPECT_LT(changed, size.width * size.height / 500);
}

}  // namespace
}  // namespace ods
