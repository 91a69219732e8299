// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The metadata that other programs find in our files: read with OpenEXR itself, with exiftool, and byte by byte.
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "ods/picture/save.h"
#include "tests/support/exr_files.h"
#include "tests/support/temporary_folder.h"

namespace ods::metadata_test {

const int kWidth = 8, kHeight = 4;

// Channel c of layer l (0 light, 1 depth, 2 normal, 3 albedo) at row y of an eye, exact in 16 bits.
float value(int eye, int layer, int c, int y) {
  return static_cast<float>(256 * eye + 64 * layer + 16 * c + y);
}

EyeImage make_eye(int eye) {
  EyeImage result{eye, Image(kWidth, kHeight, 3), Image(kWidth, kHeight, 1), Image(kWidth, kHeight, 3),
                  Image(kWidth, kHeight, 3)};
  Image* const layers[] = {&result.radiance, &result.depth, &result.normal, &result.albedo};
  for (int layer = 0; layer < 4; layer++) {
    for (int y = 0; y < kHeight; y++) {
      for (int x = 0; x < kWidth; x++) {
        for (int c = 0; c < layers[layer]->channels; c++) layers[layer]->at(x, y)[c] = value(eye, layer, c, y);
      }
    }
  }
  return result;
}

const Picture kStereo{{make_eye(kLeft), make_eye(kRight)}};
const Picture kSingle{{make_eye(kMono)}};

StereoCamera camera() {
  StereoCamera result;
  result.position = vec3(1.0f, 1.6f, -2.0f);
  result.yaw = -90.0f;
  result.pitch = 10.0f;
  result.roll = 5.0f;
  result.top.mode = kMergeCosine;
  return result;
}

struct ExrFile {
  Imf::Header header;
  Extent size;
  std::vector<std::string> channels;
  std::vector<std::byte> pixels;  // floats

  // The value of the pixel in the middle of a row; -1 if there is no such channel.
  float at(const std::string& channel, int y) const {
    const auto found = std::find(channels.begin(), channels.end(), channel);
    const size_t pixel = static_cast<size_t>(y * size.width + size.width / 2);
    const size_t place = pixel * channels.size() + static_cast<size_t>(found - channels.begin());
    return found == channels.end() ? -1.0f : sample_value(SampleType::kFloat, &pixels[4 * place]);
  }
  std::string text(const char* name) const { return exr_value<Imf::StringAttribute>(header, name); }
  float number(const char* name) const { return exr_value<Imf::FloatAttribute>(header, name); }
  bool has(const char* name) const { return header.find(name) != header.end(); }
};

ExrFile save_exr(const Picture& picture, const SaveOptions& options) {
  const TemporaryFolder folder;
  save_picture(picture, camera(), options, folder.path("a.exr"));
  ExrFile file{exr_header(folder.path("a.exr")), {}, {}, {}};
  const Imath::Box2i window = file.header.dataWindow();
  file.size = {window.max.x + 1, window.max.y + 1};
  for (auto each = file.header.channels().begin(); each != file.header.channels().end(); ++each) {
    file.channels.push_back(each.name());
  }
  ExrForm form;
  form.width = file.size.width, form.height = file.size.height, form.channels = file.channels;
  form.types.assign(form.channels.size(), Imf::FLOAT);
  file.pixels = read_exr(folder.path("a.exr"), form);
  return file;
}

// The view that OpenEXR's rules give a channel: bare names are the default view's, otherwise the last component but
// one.
std::string view_of(const std::string& channel) {
  const size_t last = channel.rfind('.');
  if (last == std::string::npos) return "left";
  const size_t before = channel.rfind('.', last - 1);
  const size_t begin = before == std::string::npos ? 0 : before + 1;
  return channel.substr(begin, last - begin);
}

TEST(Exr, MultiviewHasBothEyesInOnePart) {
  SaveOptions options;
  options.layout = Layout::kMultiview;
  const ExrFile file = save_exr(kStereo, options);
  EXPECT_EQ(file.size.width, kWidth);
  EXPECT_EQ(file.size.height, kHeight);
  ASSERT_EQ(file.channels.size(), 20u);
  EXPECT_EQ(Imf::multiView(file.header), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(file.text("ods:layout"), "multiview");
  EXPECT_FALSE(file.has("envmap")) << "envmap is for one view";
  EXPECT_EQ(std::count_if(file.channels.begin(), file.channels.end(),
                          [](const std::string& name) { return view_of(name) == "left"; }),
            10);
  EXPECT_EQ(std::count_if(file.channels.begin(), file.channels.end(),
                          [](const std::string& name) { return view_of(name) == "right"; }),
            10);
  for (int y = 0; y < kHeight; y++) {
    EXPECT_EQ(file.at("G", y), value(kLeft, 0, 1, y));
    EXPECT_EQ(file.at("Z", y), value(kLeft, 1, 0, y));
    EXPECT_EQ(file.at("N.left.Y", y), value(kLeft, 2, 1, y));
    EXPECT_EQ(file.at("albedo.left.B", y), value(kLeft, 3, 2, y));
    EXPECT_EQ(file.at("right.G", y), value(kRight, 0, 1, y));
    EXPECT_EQ(file.at("right.Z", y), value(kRight, 1, 0, y));
    EXPECT_EQ(file.at("N.right.Y", y), value(kRight, 2, 1, y));
    EXPECT_EQ(file.at("albedo.right.B", y), value(kRight, 3, 2, y));
  }
}

TEST(Exr, PackedLayoutsPackEveryLayer) {
  SaveOptions options;
  const ExrFile file = save_exr(kStereo, options);
  EXPECT_EQ(file.size.height, 2 * kHeight);
  ASSERT_EQ(file.channels.size(), 10u);
  EXPECT_FALSE(file.has("multiView"));
  for (int y = 0; y < 2 * kHeight; y++) {
    const int eye = y < kHeight ? kLeft : kRight;
    EXPECT_EQ(file.at("R", y), value(eye, 0, 0, y % kHeight));
    EXPECT_EQ(file.at("Z", y), value(eye, 1, 0, y % kHeight));
    EXPECT_EQ(file.at("N.Z", y), value(eye, 2, 2, y % kHeight));
    EXPECT_EQ(file.at("albedo.R", y), value(eye, 3, 0, y % kHeight));
  }
}

TEST(Exr, DepthKeeps32Bits) {
  const ExrFile file = save_exr(kSingle, {});
  for (const std::string& name : file.channels) {
    EXPECT_EQ(file.header.channels()[name].type, name == "Z" ? Imf::FLOAT : Imf::HALF) << name;
  }
}

TEST(Exr, SaysHowItWasTaken) {
  const ExrFile file = save_exr(kSingle, {});
  EXPECT_EQ(file.text("ods:layout"), "mono");
  EXPECT_EQ(file.text("ods:projection"), "lat-long");
  EXPECT_EQ(file.text("ods:depthType"), "ray");
  EXPECT_NE(file.text("ods:version"), "");
  EXPECT_EQ(file.number("ods:ipd"), 0.065f);
  EXPECT_EQ(file.number("ods:yaw"), -90.0f);
  EXPECT_EQ(file.number("ods:pitch"), 10.0f);
  EXPECT_EQ(file.number("ods:roll"), 5.0f);
  EXPECT_EQ(file.text("ods:poleMergeTop"), "cosine");
  EXPECT_EQ(file.number("ods:poleMergeTopStart"), 60.0f);
  EXPECT_EQ(file.number("ods:poleMergeTopEnd"), 90.0f);
  EXPECT_EQ(file.number("ods:poleMergeTopExponent"), 1.0f);
  EXPECT_EQ(file.text("ods:poleMergeBottom"), "none");
  EXPECT_EQ(file.text("colorInteropID"), "lin_rec709_scene");
  EXPECT_EQ(file.header.compression(), Imf::ZIP_COMPRESSION);
  EXPECT_FALSE(file.has("capDate")) << "equal pictures would not be equal files";
  const Imath::V3f position = exr_value<Imf::V3fAttribute>(file.header, "ods:position");
  for (int i = 0; i < 3; i++) EXPECT_EQ(position[i], camera().position[i]);
  const Imf::Chromaticities chromaticities = Imf::chromaticities(file.header);
  EXPECT_EQ(chromaticities.red.x, 0.64f);
  EXPECT_EQ(chromaticities.white.y, 0.329f);
}

TEST(Exr, OnlyAFileOfOneEyeIsAnEnvironmentMap) {
  const TemporaryFolder folder;
  save_picture(kStereo, camera(), {}, folder.path("%V.exr"));
  save_picture(kStereo, camera(), {}, folder.path("both.exr"));
  // Name, type, size 1, 0 = lat-long.
  const std::string attribute("envmap\0envmap\0\1\0\0\0\0", 19);
  EXPECT_NE(folder.read("left.exr").find(attribute), std::string::npos);
  EXPECT_NE(folder.read("right.exr").find(attribute), std::string::npos);
  EXPECT_EQ(folder.read("both.exr").find("envmap"), std::string::npos);
  EXPECT_EQ(exr_value<Imf::StringAttribute>(exr_header(folder.path("right.exr")), "view"), "right");
}

// Splits a PNG, checking every CRC, those that libpng wrote included.
std::vector<std::pair<std::string, std::string>> png_chunks(const std::string& file) {
  const auto number = [&](size_t at) {
    uint32_t n = 0;
    for (size_t i = 0; i < 4; i++) n = n * 256 + static_cast<unsigned char>(file[at + i]);
    return n;
  };
  std::vector<std::pair<std::string, std::string>> chunks;
  for (size_t at = 8; at + 12 <= file.size();) {
    const size_t length = number(at);
    uint32_t crc = 0xffffffffu;
    for (size_t i = at + 4; i < at + 8 + length; i++) {
      for (int bit = 0; bit < 8; bit++) {
        const uint32_t in = static_cast<unsigned char>(file[i]) >> bit & 1u;
        crc = (crc & 1u) != in ? crc >> 1 ^ 0xedb88320u : crc >> 1;
      }
    }
    EXPECT_EQ(~crc, number(at + 8 + length));
    chunks.emplace_back(file.substr(at + 4, 4), file.substr(at + 8, length));
    at += 12 + length;
  }
  return chunks;
}

TEST(Gpano, PngHoldsAnXmpChunk) {
  const TemporaryFolder folder;
  save_picture(kSingle, camera(), {}, folder.path("a.png"));
  const auto chunks = png_chunks(folder.read("a.png"));
  EXPECT_EQ(chunks.front().first, "IHDR");
  EXPECT_EQ(chunks.back().first, "IEND");
  const auto is = [](const char* type) { return [type](const auto& chunk) { return chunk.first == type; }; };
  const auto packet = std::find_if(chunks.begin(), chunks.end(), is("iTXt"));
  ASSERT_LT(packet, std::find_if(chunks.begin(), chunks.end(), is("IDAT"))) << "readers look before the pixels";
  EXPECT_EQ(packet->second.substr(0, 22), std::string("XML:com.adobe.xmp\0\0\0\0\0", 22));
  EXPECT_NE(packet->second.find("GPano:ProjectionType=\"equirectangular\""), std::string::npos);
  EXPECT_NE(packet->second.find("GPano:FullPanoWidthPixels=\"8\""), std::string::npos);
  EXPECT_NE(packet->second.find("GPano:PoseHeadingDegrees=\"270\""), std::string::npos);
}

TEST(Gpano, IsNotInStereoFiles) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.jpg", "a.tif", "a.webp", "a.hdr", "a.exr"}) {
    save_picture(kStereo, camera(), {}, folder.path(name));
    EXPECT_EQ(folder.read(name).find("GPano"), std::string::npos) << name;
  }
}

std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  return text;
}

TEST(Gpano, ExiftoolReadsIt) {
  if (output_of("exiftool -ver 2>/dev/null").empty()) GTEST_SKIP() << "skipped: exiftool is not installed";
  const TemporaryFolder folder;
  // Looking over the pole is the same pose with the heading turned and the roll upside down.
  StereoCamera over = camera();
  over.pitch = 170.0f;
  for (const char* name : {"a.png", "a.jpg", "a.tif", "%V.jpg"}) {
    save_picture(name[0] == '%' ? kStereo : kSingle, camera(), {}, folder.path(name));
    const std::string file = folder.path(name[0] == '%' ? "right.jpg" : name);
    const std::string command =
        "exiftool -n -s3 -sep , -p '$XMP-GPano:ProjectionType $FullPanoWidthPixels "
        "$FullPanoHeightPixels $CroppedAreaImageWidthPixels $CroppedAreaImageHeightPixels "
        "$CroppedAreaLeftPixels $CroppedAreaTopPixels $PoseHeadingDegrees $PosePitchDegrees "
        "$PoseRollDegrees' ";
    EXPECT_EQ(output_of(command + file), "equirectangular 8 4 8 4 0 0 270 10 5\n") << name;
    EXPECT_EQ(output_of("exiftool -Warning -Error " + file), "") << name;
    if (name[0] == '%') continue;
    save_picture(kSingle, over, {}, file);
    EXPECT_EQ(output_of(command + file), "equirectangular 8 4 8 4 0 0 90 10 -175\n") << name;
  }
}

}  // namespace ods::metadata_test
