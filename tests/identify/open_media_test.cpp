// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files are opened once: the pixels are decoded only if they are needed, and never again.
#include "ods/identify/open_media.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "ods/files/scratch.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"

namespace ods {
namespace {

class OpenMedia : public testing::Test {
 protected:
  std::string write(const std::string& name, std::optional<Layout> layout, const char* projection) const {
    const TwoEyes eyes = [](int eye, const ProjectionSetting& setting, Extent size) {
      StereoCamera camera;
      camera.projection = setting;
      return seen_in(World::kHall, camera, eye, size, true);
    };
    const ProjectionSetting setting = find_projection(projection)->setting;
    write_unknown(folder.path(name), {layout, setting}, eyes, unknown_eye(setting, 384));
    return folder.path(name);
  }

  TemporaryFolder folder;
};

TEST_F(OpenMedia, TheNameIsEnough) {
  const MediaFile media = open_media(write("a_180_LR.jpg", Layout::kSideBySide, "vr180"));
  EXPECT_FALSE(media.identity);
  EXPECT_FALSE(media.reader->is_decoded());
  EXPECT_EQ(media.format.layout.source, FormatSource::kName);
  EXPECT_EQ(media.format.layout.layout, Layout::kSideBySide);
}

TEST_F(OpenMedia, OptionsAreEnough) {
  const std::string path = write("a.jpg", Layout::kTopBottom, "vr180");
  MediaOptions options;
  options.known.layout = Layout::kTopBottom, options.known.projection = find_projection("vr180")->setting;
  const MediaFile media = open_media(path, options);
  EXPECT_FALSE(media.reader->is_decoded());
  EXPECT_EQ(media.format.layout.source, FormatSource::kOptions);
}

// The eyes are views into the pixels that were examined.
TEST_F(OpenMedia, APictureIsDecodedOnce) {
  for (const Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
    MediaFile media = open_media(write("a.jpg", layout, "vr180"));
    ASSERT_TRUE(media.identity && media.identity->is_sure());
    EXPECT_EQ(media.format.layout.source, FormatSource::kPixels);
    EXPECT_TRUE(media.reader->is_decoded());
    const StoredPicture whole = media.reader->whole();
    PictureReader reader = reader_of(std::move(media));
    EXPECT_EQ(reader.header().eyes[0].layers[0].first, nullptr);
    const StoredPicture picture = reader.read("");
    EXPECT_EQ(picture.layout, layout);
    EXPECT_EQ(picture.memory, whole.memory);
    ASSERT_EQ(picture.eyes.size(), 2u);
    EXPECT_EQ(picture.eyes[0].layers[0].first, whole.memory->data());
  }
}

TEST_F(OpenMedia, TheFirstFrameStandsForAll) {
  write("shot.0007.jpg", Layout::kTopBottom, "vr180");
  const MediaFile media = open_media(folder.path("shot.####.jpg"));
  EXPECT_EQ(media.path, folder.path("shot.0007.jpg"));
  EXPECT_EQ(media.hint.seen->layout, Layout::kTopBottom);
  EXPECT_THROW(open_media(folder.path("other.####.jpg")), Error);
}

TEST_F(OpenMedia, TheOrderOfPlayersIsKeptOnRequest) {
  const std::string path = write("a.jpg", Layout::kCrossEyed, "vr180");
  EXPECT_EQ(open_media(path).hint.seen->layout, Layout::kCrossEyed);
  MediaOptions options;
  options.left_first = true;
  EXPECT_EQ(open_media(path, options).hint.seen->layout, Layout::kSideBySide);
}

// As written for viewers that want two eyes.
TEST_F(OpenMedia, ANameWithMonoMayMeanThatBothEyesAreTheSame) {
  const ProjectionSetting sphere = find_projection("lat-long")->setting;
  const TwoEyes same = [](int, const ProjectionSetting& setting, Extent size) {
    StereoCamera camera;
    camera.projection = setting;
    return seen_in(World::kHall, camera, kLeft, size, true);
  };
  write_unknown(folder.path("hall_mono.jpg"), {Layout::kTopBottom, sphere}, same, unknown_eye(sphere, 384));
  const MediaFile media = open_media(folder.path("hall_mono.jpg"));
  EXPECT_EQ(media.format.layout.layout, Layout::kTopBottom);
  EXPECT_EQ(media.format.layout.source, FormatSource::kPixels);
  EXPECT_EQ(media.format.camera.projection.kind, kLatLong);

  const MediaFile one = open_media(write("one_mono.jpg", std::nullopt, "lat-long"));
  EXPECT_EQ(one.format.layout.layout, std::nullopt);
  EXPECT_EQ(one.format.layout.source, FormatSource::kName);
}

TEST_F(OpenMedia, AFlatGreyPictureShowsNothing) {
  Picture picture;
  picture.eyes.resize(1);
  picture.eyes[0].eye = kMono, picture.eyes[0].radiance = Image(300, 200, 3);
  save_picture(picture, {}, folder.path("grey.png"));
  const MediaFile media = open_media(folder.path("grey.png"));
  EXPECT_TRUE(media.identity->readings.empty());
  EXPECT_THROW(refuse_unlikely(media), Error);
}

}  // namespace
}  // namespace ods
