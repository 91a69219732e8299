// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Damaged files for every reader: 300 mutations of good ones, the same in every run. Each is read, or refused by
// ods::Error. Whatever else ends the process leaves its file behind: "mutant.*" in the temporary folder. The program
// sanitized_readers runs these tests a second time, with the readers under sanitizers.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "ods/base/error.h"
#include "ods/convert/video/turn_keys.h"
#include "ods/depth/depth_file.h"
#include "ods/farm/plan.h"
#include "ods/image/codec/ktx2.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/scene/gltf/gltf.h"
#include "ods/scene/motion.h"
#include "ods/stitch/slit_file.h"
#include "ods/video/container/video_file.h"
#include "ods/video/decode.h"
#include "ods/view/beside.h"
#include "ods/view/tour.h"
#include "tests/support/compressed_gltf.h"
#include "tests/support/made_frames.h"
#include "tests/support/places.h"
#include "tests/support/programs.h"
#include "tests/support/scene_check.h"
#include "tests/support/temporary_folder.h"

namespace ods::mutation_test {

constexpr int kMutations = 300;
constexpr long kMegabytes = 1536;         // in memory at most; small files ask for no more
constexpr int64_t kManyPixels = 1 << 18;  // a file that claims to be larger is only opened
constexpr std::string_view kExtremes[] = {
    std::string_view("\0\0\0\0", 4),   std::string_view("\xff\xff\xff\xff", 4), std::string_view("\x7f\xff\xff\xff", 4),
    std::string_view("\0\0\0\x80", 4), std::string_view("1e999999", 8),         std::string_view("\x9b\x1b[2J", 5)};

class Mutations : public ::testing::Test {
 protected:
  using Reader = std::function<void(const std::string& path)>;

  void SetUp() override { save("picture.png", Layout::kTopBottom); }
  void TearDown() override {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    EXPECT_LT(used.ru_maxrss >> 10, kMegabytes) << "a damaged file has led a reader into much memory";
  }

  // Pictures of 64 x 32 pixels of noise an eye, so that most bytes are pixels.
  void save(const std::string& name, Layout layout, int frame = 1) {
    Picture picture = made::red_and_blue({64, 32}, frame);
    std::mt19937 random(static_cast<uint32_t>(frame));
    for (EyeImage& eye : picture.eyes) {
      for (float& value : eye.radiance.pixels) value *= static_cast<float>(random() % 256) / 255.0f;
    }
    SaveOptions options;
    options.layout = layout;
    save_picture(picture, options, folder.path(name));
  }

  std::string saved(const std::string& name, Layout layout = Layout::kTopBottom) {
    save(name, layout);
    return folder.read(name);
  }

  // The files that a program makes of picture.png, or of frames of it: {} in the line is the folder.
  std::string made_by(std::string line, const std::string& name) {
    for (size_t at = 0; (at = line.find("{}")) != std::string::npos;) line.replace(at, 2, folder.path(""));
    const Ran ran = run_line(line);
    EXPECT_EQ(ran.code, 0) << ran.out;
    return folder.read(name);
  }

  std::string video(const std::string& name, const std::string& options) {
    for (int frame = 1; frame <= 4; frame++) save("frame." + std::to_string(frame) + ".png", Layout::kTopBottom, frame);
    return made_by("SVT_LOG=0 " + ods_command() + " encode -q {}frame.#.png " + options + " -o {}" + name, name);
  }

  std::string mutated(const std::string& good, std::mt19937& random) const {
    std::string bytes = good;
    const auto place = [&] { return random() % bytes.size(); };
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < changes && !bytes.empty(); i++) {
      const size_t at = random() % 2 == 0 ? place() : place() % std::min<size_t>(bytes.size(), 512);  // headers
      const std::string_view extreme = kExtremes[random() % std::size(kExtremes)];
      switch (random() % 6) {
        case 0:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
          break;
        case 1:
          bytes[at] = static_cast<char>(random());
          break;
        case 2:
          bytes.replace(at, extreme.size(), extreme);
          break;
        case 3:
          bytes.erase(at, 1 + random() % 64);
          break;
        case 4:
          bytes.insert(at, bytes.substr(place(), 1 + random() % 64));
          break;
        default:
          if (i == 0) bytes.resize(at);
      }
    }
    return bytes;
  }

  void try_all(const std::vector<std::string>& good, const std::string& ending, const Reader& reader) {
    const std::string name = "mutant" + ending;
    int read = 0;
    for (int seed = 0; seed < kMutations + static_cast<int>(good.size()); seed++) {
      const bool is_good = seed >= kMutations;
      std::mt19937 random(static_cast<uint32_t>(seed));
      const std::string& from = good[static_cast<size_t>(seed) % good.size()];
      folder.write(name, is_good ? good[static_cast<size_t>(seed - kMutations)] : mutated(from, random));
      try {
        reader(folder.path(name));
        read++;
      } catch (const Error& error) {
        EXPECT_FALSE(is_good) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "seed " << seed << ": " << error.what();
      } catch (const std::exception& error) {
        ADD_FAILURE() << "seed " << seed << ": " << error.what();
      }
    }
    RecordProperty("read", read);
  }

  TemporaryFolder folder;
};

void read_picture(const std::string& path) {
  const FileInfo info = read_info(path);
  if (int64_t{info.width} * info.height <= kManyPixels) open_picture(path);
}

void read_scene(const std::string& path) {
  Scene scene = load_gltf(path);
  if (const std::string broken = broken_promise(scene); !broken.empty()) throw std::logic_error(broken);
  play(scene.animation, "");
  set_time(scene, 0.4);
}

void read_video(const std::string& path) {
  const VideoFile video = read_video_file(path);
  const uint64_t track = choose_track(video, {}, path).id;
  VideoDecoder decoder(path, track, Views::kFirst, 1);
  const Extent size = decoder.stream().size;
  if (int64_t{size.width} * size.height > kManyPixels) return;
  for (int i = 0; i < 8 && decoder.next(); i++) {
  }
}

TEST_F(Mutations, Png) {
  try_all({folder.read("picture.png")}, ".png", read_picture);
}
TEST_F(Mutations, Jpeg) {
  const std::string photo =
      made_by(ods_command() + " render furnace -q --width 32 --samples 1 -o {}a.vr.jpg", "a.vr.jpg");
  try_all({saved("a.jpg"), photo}, ".vr.jpg", read_picture);
}
TEST_F(Mutations, Tiff) {
  try_all({saved("a.tif")}, ".tif", read_picture);
}
TEST_F(Mutations, WebP) {
  try_all({saved("a.webp")}, ".webp", read_picture);
}
TEST_F(Mutations, Exr) {
  try_all({saved("a.exr"), saved("b.exr", Layout::kMultiview)}, ".exr", read_picture);
}
TEST_F(Mutations, Hdr) {
  try_all({saved("a.hdr")}, ".hdr", read_picture);
}

TEST_F(Mutations, Heic) {
  if (const std::string why = missing("heif-enc", "heif-enc --help >/dev/null 2>&1"); !why.empty()) GTEST_SKIP() << why;
  try_all({made_by("heif-enc {}picture.png -o {}a.heic", "a.heic")}, ".heic", read_picture);
}

TEST_F(Mutations, Mp4) {
  try_all({video("a.mp4", "--codec h264"), video("b.mp4", "--codec hevc"), video("c.mov", "--codec prores")}, ".mp4",
          read_video);
}

TEST_F(Mutations, Matroska) {
  try_all({video("a.mkv", "--codec h264"), video("b.webm", "--codec vp9")}, ".mkv", read_video);
}

TEST_F(Mutations, Glb) {
  GltfBuilder draco = make_grid(4), meshopt = make_grid(4);
  compress_draco(draco, draco.primitive());
  compress_meshopt(meshopt, 0, "ATTRIBUTES", 12);
  std::vector<std::string> files;
  for (const GltfBuilder& each : {make_triangle(), make_grid(3), draco, meshopt}) {
    const Binary bytes = each.glb();
    files.emplace_back(bytes.begin(), bytes.end());
  }
  try_all(files, ".glb", read_scene);
}

TEST_F(Mutations, Ktx2) {
  std::vector<std::string> files;
  for (const char* name : {"etc1s", "etc1s_alpha", "uastc", "uastc_zstd"}) {
    std::ifstream file(source_folder() + "/tests/image/codec/" + name + ".ktx2", std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  try_all(files, ".ktx2", [&](const std::string& path) {
    const std::string bytes = folder.read(std::filesystem::path(path).filename());
    decode_ktx2(std::as_bytes(std::span(bytes)), path);
  });
}

TEST_F(Mutations, Depth) {
  const std::string numbers(std::string(8 * 4 * sizeof(float), '?'));
  try_all({"Pf\n8 4\n-1.0\n" + numbers}, ".pfm", [](const std::string& path) { read_depth_numbers(path); });
}

TEST_F(Mutations, Rig) {
  SlitOptions options;
  options.slits = 4;
  try_all({write_slit_rig(make_slit_rig({}, {64, 32}, {kLeft, kRight}, options))}, ".json",
          [](const std::string& path) {
            std::vector<std::string> warnings;
            load_slit_rig(path, warnings);
          });
}

TEST_F(Mutations, Sidecar) {
  Sidecar sidecar;
  sidecar.eye = {64, 32};
  try_all({write_sidecar(sidecar)}, ".json", [](const std::string& path) {
    std::vector<std::string> warnings;
    load_sidecar(path, warnings);
  });
}

TEST_F(Mutations, Plan) {
  FarmPlan plan;
  plan.name = "film", plan.folder = "/disk", plan.program = "ods";
  plan.paths = {{"/disk/a.glb"}};
  plan.groups = {{"frames", {"video", "/disk/a.glb"}, "--only", 12}};
  try_all({write_plan(plan)}, ".json",
          [&](const std::string& path) { read_plan(folder.read(std::filesystem::path(path).filename()), path); });
}

TEST_F(Mutations, Keys) {
  try_all({"0 90 0 0\n0:01 -5 1.5 0\n00:00:02.5 0 0 12\n"}, ".keys",
          [](const std::string& path) { read_turn_keys(path); });
}

// The notes and subtitles that lie beside a picture or a video.
TEST_F(Mutations, Beside) {
  try_all({"WEBVTT\n\n00:01.000 --> 00:04.000\nwords\n"}, ".vtt",
          [&](const std::string&) { read_subtitles(folder.path("mutant.mp4")); });
  try_all({R"({"caption": "words", "hotspots": [{"yaw": 1.5, "pitch": 2, "title": "a", "text": "words"}]})"},
          ".notes.json", [&](const std::string&) { read_notes(folder.path("mutant.png")); });
  try_all(
      {R"({"panoramas": [{"file": "picture.png", "place": [1, 2, 3], "links": [{"to": "b", "yaw": 5}], "floor": 0.5},
              {"file": "picture.png", "name": "b", "on_plan": [1, 2]}], "height": 1.5,
              "plan": {"image": "picture.png", "metres_per_pixel": 0.01}})"},
      ".json", [&](const std::string& path) { read_tour(path); });
}

}  // namespace ods::mutation_test
