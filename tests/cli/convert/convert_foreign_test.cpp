// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of docs/foreign.md: each of its commands is run as printed, on a file made as the camera or the program of
// its row writes it, and its output shows the world of that file. If ods stops, it names the alternative.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "ods/base/bytes.h"
#include "ods/files/read_file.h"
#include "ods/image/heif_items.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/save.h"
#include "ods/video/encode.h"
#include "ods/video/video_input.h"
#include "tests/support/camera_photos.h"
#include "tests/support/cli_runner.h"
#include "tests/support/heif_boxes.h"
#include "tests/support/mesh_writer.h"
#include "tests/support/programs.h"
#include "tests/support/stereo_jpegs.h"
#include "tests/support/worlds.h"

namespace ods::foreign_files_test {

ProjectionSetting named(const std::string& name) {
  return find_projection(name)->setting;
}

// --- pixels ----------------------------------------------------------------------------------------------------------

constexpr World kWorld = World::kHall;

// A picture of two cameras side by side, unless it is one eye.
Image view(const ProjectionSetting& projection, int eye, Extent size, float yaw = 0.0f) {
  StereoCamera camera;
  camera.projection = projection, camera.yaw = yaw;
  return seen_in(kWorld, camera, eye, size, eye != kMono);
}

// `part` at a place of `whole`, as far as it fits; a place may be outside.
void paste(Image& whole, const Image& part, int left, int top) {
  for (int y = std::max(0, -top); y < std::min(part.height, whole.height - top); y++) {
    for (int x = std::max(0, -left); x < std::min(part.width, whole.width - left); x++) {
      std::copy_n(part.at(x, y), 3, whole.at(left + x, top + y));
    }
  }
}

Image beside(const Image& left, const Image& right) {
  Image both(left.width + right.width, left.height, 3);
  paste(both, left, 0, 0), paste(both, right, left.width, 0);
  return both;
}

Image both_eyes(const char* projection, Extent eye) {
  return beside(view(named(projection), kLeft, eye), view(named(projection), kRight, eye));
}

Image of_height(const Image& image, int height) {
  Image result(image.width, height, 3);
  for (int y = 0; y < height; y++) {
    const float at = (static_cast<float>(y) + 0.5f) * static_cast<float>(image.height) / static_cast<float>(height);
    const int row = std::clamp(static_cast<int>(at - 0.5f), 0, image.height - 2);
    const float share = std::clamp(at - 0.5f - static_cast<float>(row), 0.0f, 1.0f);
    for (int x = 0; x < 3 * image.width; x++) {
      result.at(0, y)[x] = std::lerp(image.at(0, row)[x], image.at(0, row + 1)[x], share);
    }
  }
  return result;
}

// With black above and below it.
Image with_bars(const Image& image, int height) {
  Image file(image.width, height, 3);
  paste(file, image, 0, (height - image.height) / 2);
  return file;
}

// Upside down, as a camera stores what it saw upside down.
Image half_turned(const Image& image) {
  Image turned = image;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      std::copy_n(image.at(image.width - 1 - x, image.height - 1 - y), 3, turned.at(x, y));
    }
  }
  return turned;
}

// --- files -----------------------------------------------------------------------------------------------------------

void write_picture(const std::string& path, const Image& image) {
  Picture picture;
  picture.eyes.resize(1);
  picture.eyes[0].eye = kMono, picture.eyes[0].radiance = image;
  SaveOptions options;
  options.layout = Layout::kSeparate, options.tone = ToneCurve::kLinear, options.jpeg_quality = 92;
  save_picture(picture, options, path);
}

std::string jpeg_of(const TemporaryFolder& folder, const Image& image) {
  write_picture(folder.path("whole.jpg"), image);
  const std::string bytes = folder.read("whole.jpg");
  std::filesystem::remove(folder.path("whole.jpg"));
  return bytes;
}

// Three frames without metadata.
void write_film(const std::string& path, const Image& image) {
  const Extent size{image.width, image.height};
  EncodeOptions options;
  options.packing.quality = 16, options.preset = "ultrafast";
  AtomicFile file(path);
  VideoEncoder encoder(file, *container_of_path(path), size, options);
  const auto frame = std::make_shared<VideoFrame>(size, options.packing);
  const auto row = [&](int y, std::span<float> out) {
    for (int x = 0; x < size.width; x++) {
      for (int c = 0; c < 3; c++) {
        out[static_cast<size_t>(c * size.width + x)] = srgb_encode(std::clamp(image.at(x, y)[c], 0.0f, 1.0f));
      }
    }
  };
  put_ycbcr(row, size, frame->planes());
  for (int i = 0; i < 3; i++) encoder.add(frame, {i, 1});
  encoder.finish();
  file.commit();
}

// Adds boxes at the end of the sample entry.
void add_entry_boxes(const TemporaryFolder& folder, const std::string& name, const std::string& boxes) {
  std::string video = folder.read(name);
  const std::vector<std::string> way = {"moov", "trak", "mdia", "minf", "stbl", "stsd", "avc1"};
  const size_t place = made::find(video, way).at(0).end;
  const bool is_before_data = place < made::find(video, {"mdat"}).at(0).box;
  const size_t table = made::find(video, {"moov", "trak", "mdia", "minf", "stbl", "stco"}).at(0).begin;
  for (size_t at = table + 8; is_before_data && at < table + 8 + 4 * made::value(video, table + 4, 4); at += 4) {
    video.replace(at, 4, made::number(made::value(video, at, 4) + boxes.size(), 4));
  }
  for (size_t depth = 1; depth <= way.size(); depth++) {
    const size_t at = made::find(video, {way.begin(), way.begin() + static_cast<ptrdiff_t>(depth)}).at(0).box;
    video.replace(at, 4, made::number(made::value(video, at, 4) + boxes.size(), 4));
  }
  folder.write(name, video.insert(place, boxes));
}

// The display matrix of a track: how its pictures are to be turned.
void turn_track(const TemporaryFolder& folder, const std::string& name, bool is_half) {
  std::string video = folder.read(name);
  const size_t matrix = made::find(video, {"moov", "trak", "tkhd"}).at(0).begin + 40;
  const uint64_t one = 1u << 16, minus = 0xffff0000u;
  const std::array<uint64_t, 4> turn =
      is_half ? std::array{minus, uint64_t{0}, uint64_t{0}, minus} : std::array{uint64_t{0}, one, minus, uint64_t{0}};
  const std::array<size_t, 4> places = {0, 4, 12, 16};
  for (size_t i = 0; i < 4; i++) video.replace(matrix + places[i], 4, made::number(turn[i], 4));
  folder.write(name, video);
}

void write_heif(const TemporaryFolder& folder, const std::string& name, const std::vector<Image>& pictures) {
  std::string line = name.ends_with("avif") ? "heif-enc -A -q 90" : "heif-enc -q 90";
  for (size_t i = 0; i < pictures.size(); i++) {
    const std::string source = folder.path(fmt::format("source{}.png", i));
    write_picture(source, pictures[i]);
    line += " " + source;
  }
  ASSERT_EQ(run_line(line + " -o " + folder.path(name)).code, 0);
}

// --- the rows --------------------------------------------------------------------------------------------------------

struct Form {
  std::string projection;  // by name
  int eyes = 2;
};

struct Row {
  std::string kind;     // as the first column begins
  std::string command;  // as the last one has it
  std::function<void(const TemporaryFolder& folder, const std::string& name)> make;
  Form form;        // of what comes out
  std::string why;  // instead: the error's message
  bool needs_heif = false;
};
void PrintTo(const Row& row, std::ostream* out) {
  *out << row.command;
}

void make_mesh_film(const TemporaryFolder& folder, const std::string& name) {
  write_film(folder.path(name), both_eyes("fisheye", {512, 512}));
  const std::string none(4, '\0'), mesh = box_body({fisheye_mesh(41), fisheye_mesh(41)}, true);
  add_entry_boxes(
      folder, name,
      made::box("st3d", none + made::number(2, 1)) +
          made::box("sv3d", made::box("svhd", none + std::string("camera\0", 7)) +
                                made::box("proj", made::box("prhd", std::string(16, '\0')) + made::box("mshp", mesh))));
}

// The sensor is less high than the circles.
void make_cut_circles(const TemporaryFolder& folder, const std::string& name) {
  const auto cut = [](int eye) {
    Image sensor(800, 600, 3);
    paste(sensor, view(named("fisheye"), eye, {720, 720}), 40, -60);
    return sensor;
  };
  write_film(folder.path(name), beside(cut(kLeft), cut(kRight)));
}

void make_two_lenses(const TemporaryFolder& folder, const std::string& name) {
  ProjectionSetting lens = named("fisheye");
  lens.fov = 195.0f;
  const auto seen = [&](float yaw) { return view(lens, kMono, {600, 600}, yaw); };
  write_film(folder.path(name), beside(seen(0.0f), seen(180.0f)));
}

void make_vr180_photo(const TemporaryFolder& folder, const std::string& name) {
  const std::string left = jpeg_of(folder, view(named("vr180"), kLeft, {512, 512}));
  const std::string right = jpeg_of(folder, view(named("vr180"), kRight, {512, 512}));
  folder.write(name, photo_of(left, crop("512", "512", "256", "0"), in_lines(right)));
}

void make_cardboard_photo(const TemporaryFolder& folder, const std::string& name) {
  Picture picture;
  for (const int eye : {kLeft, kRight}) {
    EyeImage& image = picture.eyes.emplace_back();
    image.eye = eye, image.radiance = view(named("lat-long"), eye, {512, 256});
  }
  SaveOptions options;
  options.tone = ToneCurve::kLinear;
  save_picture(picture, StereoCamera(), options, folder.path(name));
}

void make_turned_photo(const TemporaryFolder& folder, const std::string& name) {
  const std::string plain = jpeg_of(folder, half_turned(view(named("lat-long"), kMono, {1024, 512})));
  const std::string exif = std::string("Exif\0\0II*\0\10\0\0\0\1\0\x12\1\3\0\1\0\0\0\3\0\0\0\0\0\0\0", 32);
  folder.write(name, plain.substr(0, 2) + jpeg_segment(kJpegApp1, exif) + plain.substr(2));
}

// The view of a phone's lens.
ProjectionSetting phone_window() {
  ProjectionSetting window = named("perspective");
  window.fov = 63.4f, window.aspect = 4.0f / 3.0f;
  return window;
}

void make_spatial_photo(const TemporaryFolder& folder, const std::string& name) {
  const auto seen = [&](int eye) { return view(phone_window(), eye, {640, 480}); };
  write_heif(folder, name, {seen(kLeft), seen(kRight)});
  const uint32_t primary = read_heif_items(FileInput(folder.path(name))).primary;
  const std::string items = made::number(primary, 4) + made::number(primary == 1 ? 2 : 1, 4);
  const std::string camera = made::number(0x1000, 4) + made::number(static_cast<uint64_t>(0.8096 * 65536), 4) +
                             made::number(32768, 4) + made::number(32768, 4);
  folder.write(name, with_meta(folder.read(name),
                               made::box("grpl", made::box("ster", made::number(0, 4) + made::number(99, 4) +
                                                                       made::number(2, 4) + items)),
                               made::box("cmin", camera)));
}

void make_mpo(const TemporaryFolder& folder, const std::string& name) {
  const auto seen = [&](int eye) { return jpeg_of(folder, view(phone_window(), eye, {640, 480})); };
  folder.write(name, made::mpo(seen(kLeft), seen(kRight)));
}

void make_jps(const TemporaryFolder& folder, const std::string& name) {
  const auto seen = [&](int eye) { return view(phone_window(), eye, {640, 480}); };
  folder.write(name, made::jps(jpeg_of(folder, beside(seen(kRight), seen(kLeft))), 0, 2));
}

// Rows of both eyes in turn, and Matroska's metadata about them.
void make_rows(const TemporaryFolder& folder, const std::string& name) {
  const Extent size{1024, 512};
  Image both(size.width, 2 * size.height, 3);
  for (const int eye : {kLeft, kRight}) {
    const Image one = view(named("lat-long"), eye, size);
    for (int y = 0; y < size.height; y++) std::copy_n(one.at(0, y), 3 * size.width, both.at(0, 2 * y + eye));
  }
  const std::string plain = folder.path("plain.mkv");
  write_film(plain, both);
  SphericalMetadata metadata;
  metadata.stereo = VideoStereo::kRows, metadata.projection = VideoProjection::kEquirect;
  tag_video(plain, folder.path(name), read_video_file(plain).tracks.at(0).id, metadata);
}

std::vector<Row> photo_rows() {
  const auto lat_long = [] { return view(named("lat-long"), kMono, {1024, 512}); };
  return {
      {"VR photo", "ods convert IMG_0104.vr.jpg -o andes_180_LR.jpg", make_vr180_photo, {"vr180"}, ""},
      {"VR photo", "ods convert cardboard.vr.jpg -o andes_360_TB.jpg", make_cardboard_photo, {"lat-long"}, ""},
      {"HEIC",
       "ods convert photo.heic -o photo_360.jpg",
       [=](const TemporaryFolder& folder, const std::string& name) { write_heif(folder, name, {lat_long()}); },
       {"lat-long", 1},
       "",
       true},
      {"spatial photo", "ods convert spatial.heic -o window_LR.jpg", make_spatial_photo, {"perspective"}, "", true},
      {"MPO", "ods convert trip.mpo -o trip_LR.jpg", make_mpo, {"perspective"}, ""},
      {"JPS", "ods convert cross.jps -o cross_LR.jpg", make_jps, {"perspective"}, ""},
      {"photo stored turned", "ods convert held_360.jpg -o upright_360.jpg", make_turned_photo, {"lat-long", 1}, ""},
      {"360 in black bars",
       "ods convert sent.jpg -o world_360.jpg",
       [=](const TemporaryFolder& folder, const std::string& name) {
         write_picture(folder.path(name), with_bars(lat_long(), 576));
       },
       {"lat-long", 1},
       ""},
  };
}

std::vector<Row> film_rows() {
  const auto film = [](const std::function<Image()>& image) {
    return [image](const TemporaryFolder& folder, const std::string& name) { write_film(folder.path(name), image()); };
  };
  const auto vr180 = [] { return both_eyes("vr180", {640, 640}); };
  return {
      {"VR180 video with a mesh", "ods convert mirage.mp4 -o talk_180_LR.mp4", make_mesh_film, {"vr180"}, ""},
      {"pair of fisheyes", "ods convert canon.mov -o talk_180_LR.mp4", make_cut_circles, {"vr180"}, ""},
      {"fisheyes ahead", "ods convert gear360.mp4 -o world_360.mp4", make_two_lenses, {"lat-long", 1}, ""},
      {"video of interleaved rows", "ods convert rows.mkv -o world_360_TB.mp4", make_rows, {"lat-long"}, ""},
      {"VR180 squeezed",
       "ods convert squeezed.mp4 -o talk_180_LR.mp4",
       film([=] { return of_height(vr180(), 720); }),
       {"vr180"},
       ""},
      {"VR180 squeezed",
       "ods convert letterboxed.mp4 -o talk_180_LR.mp4",
       film([=] { return with_bars(vr180(), 720); }),
       {"vr180"},
       ""},
      {"video stored turned",
       "ods convert held_360.mp4 -o upright_360.mp4",
       [=](const TemporaryFolder& folder, const std::string& name) {
         write_film(folder.path(name), half_turned(view(named("lat-long"), kMono, {1024, 512})));
         turn_track(folder, name, true);
       },
       {"lat-long", 1},
       ""},
  };
}

std::vector<Row> refused_rows() {
  return {
      {"anaglyph",
       "ods convert red_cyan.jpg -o eyes_LR.jpg",
       [](const TemporaryFolder& folder, const std::string& name) {
         Image mixed = view(named("perspective"), kRight, {640, 480});
         const Image left = view(named("perspective"), kLeft, {640, 480});
         for (size_t i = 0; i < mixed.pixels.size(); i += 3) mixed.pixels[i] = left.pixels[i];
         write_picture(folder.path(name), mixed);
       },
       {},
       "anaglyph"},
      {"strip of six faces",
       "ods convert skybox.png -o world_360.jpg",
       [](const TemporaryFolder& folder, const std::string& name) {
         StereoCamera camera;
         camera.projection = named("cube-6x1"), camera.pitch = 90.0f;
         write_picture(folder.path(name), seen_in(kWorld, camera, kMono, {1536, 256}));
       },
       {},
       "faces of a cube"},
      {"spatial video",
       "ods convert spatial.mov -o eyes_LR.mp4",
       [](const TemporaryFolder& folder, const std::string& name) {
         std::filesystem::copy_file(source_folder() + "/tests/video/layers.mov", folder.path(name));
       },
       {"perspective"},
       can_decode_both_views() ? "" : "ffmpeg"},
      {"video stored turned",
       "ods convert phone.mp4 -o upright_360.mp4",
       [](const TemporaryFolder& folder, const std::string& name) {
         write_film(folder.path(name), view(named("lat-long"), kMono, {512, 256}));
         turn_track(folder, name, false);
       },
       {},
       "ffmpeg -i"},
      {"raw photo",
       "ods convert raw.cr3 -o photo.jpg",
       [](const TemporaryFolder& folder, const std::string& name) {
         folder.write(name, std::string("\0\0\0\x18", 4) + "ftypcrx " + std::string(20, '\0'));
       },
       {},
       "Canon"},
  };
}

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  for (const auto& some : {photo_rows(), film_rows(), refused_rows()})
    rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

// --- what comes out --------------------------------------------------------------------------------------------------

// The form by which players interpret it. Pictures do not record how wide a window is.
StoredPicture open_result(const std::string& path, const Form& form) {
  OpenOptions options;
  if (form.projection == "perspective") options.format.projection = phone_window();
  if (!is_video(path)) return open_picture(path, options);
  const VideoInput video = open_video(path, options.format);
  VideoDecoder decoder(path, video.track);
  return picture_of(video, decoder.stream(), *decoder.next());
}

// The mean difference between an eye and the world, as displays show them, away from the edges: there a lens ends.
double difference(const Image& grey, const ProjectionSetting& projection, int eye) {
  const Image world = view(projection, eye, {grey.width, grey.height});
  double sum = 0.0, count = 0.0;
  const int margin = grey.height / 6;
  for (int y = margin; y < grey.height - margin; y++) {
    for (int x = margin; x < grey.width - margin; x++) {
      const float* color = world.at(x, y);
      const float light = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
      sum += static_cast<double>(std::abs(srgb_encode(light) - srgb_encode(std::max(*grey.at(x, y), 0.0f)))), count++;
    }
  }
  return sum / count;
}

class ForeignFiles : public Cli, public testing::WithParamInterface<Row> {};

TEST_P(ForeignFiles, GoToAHeadsetByOneCommand) {
  const Row& row = GetParam();
  if (row.needs_heif) {
    if (const std::string why = missing("heif-enc", "heif-enc --help >/dev/null 2>&1"); !why.empty())
      GTEST_SKIP() << why;
  }
  std::smatch names;
  ASSERT_TRUE(std::regex_match(row.command, names, std::regex("ods convert (\\S+) -o (\\S+)")));
  row.make(folder, names[1]);
  const std::string made = folder.path(names[2]);
  const int code = run(fmt::format("convert {} -o {} -q", folder.path(names[1]), made));
  if (!row.why.empty()) {
    EXPECT_EQ(code, 3) << err;
    EXPECT_NE(err.find(row.why), std::string::npos) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_FALSE(std::filesystem::exists(made));
    return;
  }
  ASSERT_EQ(code, 0) << err;
  const StoredPicture result = open_result(made, row.form);
  ASSERT_EQ(static_cast<int>(result.eyes.size()), row.form.eyes);
  EXPECT_EQ(projection_name(result.camera.projection), row.form.projection);
  const std::vector<Image> eyes = grey_eyes(result);
  for (size_t i = 0; i < eyes.size(); i++) {
    const int eye = eyes.size() == 1 ? kMono : static_cast<int>(i);
    EXPECT_LT(difference(eyes[i], result.camera.projection, eye), 0.03) << i;
    if (eyes.size() == 2) {
      EXPECT_LT(difference(eyes[i], result.camera.projection, eye),
                0.8 * difference(eyes[1 - i], result.camera.projection, eye))
          << "the eyes in their order";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, ForeignFiles, testing::ValuesIn(all_rows()), [](const auto& row) {
  return std::regex_replace(row.param.command.substr(12), std::regex("[^A-Za-z0-9]+"), "_");
});

// --- the page --------------------------------------------------------------------------------------------------------

// Every row of the page has a command, and every command a test of that row.
TEST(ForeignPage, HasACommandInEveryRowAndATestForEachCommand) {
  std::ifstream page(source_folder() + "/docs/foreign.md");
  std::set<std::string> printed, tested;
  bool is_inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| kind | camera")) is_inside = true;
    if (is_inside && line.empty()) break;
    if (!is_inside || line.starts_with("|---") || line.starts_with("| kind")) continue;
    const std::string kind = line.substr(2, line.find(" | ") - 2);
    const std::string last = line.substr(line.rfind(" | ") + 3);
    size_t count = 0;
    const std::regex command("`(ods [^`]+)`");
    for (std::sregex_iterator each(last.begin(), last.end(), command), end; each != end; ++each, count++) {
      for (const Row& row : all_rows()) {
        if (row.command == (*each)[1].str() && kind.starts_with(row.kind)) tested.insert((*each)[1]);
      }
      printed.insert((*each)[1]);
    }
    EXPECT_GT(count, 0u) << kind;
  }
  EXPECT_GT(printed.size(), 10u);
  EXPECT_EQ(printed, tested);
  EXPECT_EQ(printed.size(), all_rows().size());
}

}  // namespace ods::foreign_files_test
