// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files from untrusted sources: the paths in them lead nowhere else, and damage is reported with the file's name.
#include <OpenEXR/ImfStringAttribute.h>

#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "tests/outside/outside.h"
#include "tests/support/exr_files.h"

namespace ods::hostile_files_test {

class HostileFiles : public Outside {};

// The names of a Cryptomatte may be in a file beside it; no other file comes across.
TEST_F(HostileFiles, ACryptomattesManifestIsNotCopied) {
  ExrForm form;
  form.width = 64, form.height = 32;
  form.channels = {"B", "CryptoObject00.A", "CryptoObject00.B", "CryptoObject00.G", "CryptoObject00.R", "G", "R"};
  std::filesystem::create_directory(folder.path("notes"));
  for (const char* name : {"notes/secret.txt", "secret.txt", ".secret.json", "notes/secret.json"}) {
    folder.write(name, "the secret of the person who converts");
    form.prepare = [&](Imf::Header& header) {
      const auto say = [&](const char* key, const char* text) {
        header.insert(std::string("cryptomatte/1234567/") + key, Imf::StringAttribute(text));
      };
      say("name", "CryptoObject"), say("hash", "MurmurHash3_32"), say("conversion", "uint32_to_float32");
      say("manif_file", name);
    };
    write_exr_of(folder.path("in_360.exr"), form, std::vector<float>(64 * 32 * form.channels.size(), 0.5f));
    const Ran ran = shell("ods convert in_360.exr --layout mono -o out.exr --width 32 -q");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_EQ(folder.read("out.exr").find("the secret of"), std::string::npos) << name;
    EXPECT_EQ(ran.out.find("the secret of"), std::string::npos) << ran.out;
  }
}

// A full disk or a power cut: the list of settings of a video's frames ends in the middle.
TEST_F(HostileFiles, ACutListOfSettingsIsDamaged) {
  const std::vector<std::string> words = {"video",       "axis",      "-o", folder.path("v.mp4"), "--width",
                                          "64",          "--samples", "64", "--frames",           "1-20",
                                          "--turntable", "2",         "-q"};
  Ods first(words);
  ASSERT_TRUE(soon([&] { return std::filesystem::exists(folder.path("v.mp4.frames/frame.000002.exr")); }));
  first.kill(SIGKILL);
  first.finish();
  const std::string list = folder.read("v.mp4.frames/job.txt");
  folder.write("v.mp4.frames/job.txt", list.substr(0, list.size() / 2));
  Ods again(words);
  EXPECT_EQ(again.finish(), 3) << again.err;
  EXPECT_NE(again.err.find("job.txt"), std::string::npos) << again.err;
  EXPECT_EQ(again.err.find("with other options"), std::string::npos) << again.err;
}

TEST_F(HostileFiles, ErrorsNameTheirFile) {
  if (kSanitized) GTEST_SKIP() << "skipped: sanitizers take all the address space";
  make_picture("one_360_TB.png"), make_picture("two_360_TB.png", "--width 32");
  const Ran compared = shell("ods compare one_360_TB.png two_360_TB.png");
  EXPECT_EQ(compared.code, 3);
  EXPECT_NE(compared.out.find("one_360_TB.png"), std::string::npos) << compared.out;
  EXPECT_NE(compared.out.find("two_360_TB.png"), std::string::npos) << compared.out;
  FileHeader header;
  header.width = 8192, header.height = 8192;
  header.channels = {{"R", SampleType::kUint8}, {"G", SampleType::kUint8}, {"B", SampleType::kUint8}};
  AtomicFile file(folder.path("big_360_TB.png"));
  write_image(file, header, [](int, std::span<float> row) { std::fill(row.begin(), row.end(), 0.5f); });
  file.commit();
  const Ran linted = shell("ulimit -v 700000; ods lint big_360_TB.png");
  EXPECT_EQ(linted.code, 1) << linted.out;
  EXPECT_NE(linted.out.find("big_360_TB.png"), std::string::npos) << linted.out;
}

// Bytes of a file's name and of a video's metadata reach the terminal as text: 0x9b and ESC begin its commands.
TEST_F(HostileFiles, NothingMovesTheTerminal) {
  if (const std::string why = missing("ffmpeg", "command -v ffmpeg"); !why.empty()) GTEST_SKIP() << why;
  make_picture("frame_TB.1.png");
  ASSERT_EQ(shell("ods encode frame_TB.#.png --codec h264 -q -o plain_360_TB.mp4").code, 0);
  ASSERT_EQ(shell("ffmpeg -v error -i plain_360_TB.mp4 -c copy film_360_TB.mp4").code, 0);
  std::string film = folder.read("film_360_TB.mp4");
  for (size_t at = 0; (at = film.find("Lavf", at)) != std::string::npos;) film.replace(at, 4, "L\x9b\x1bv");
  folder.write("film_360_TB.mp4", film);
  const std::string picture = folder.path("a\x1b[2J\x9b_360_TB.png");
  std::filesystem::copy_file(folder.path("frame_TB.1.png"), picture);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"probe", folder.path("film_360_TB.mp4")},
                                                {"lint", folder.path("film_360_TB.mp4")},
                                                {"probe", picture},
                                                {"lint", picture},
                                                {"compare", picture, picture},
                                                {"comfort", picture}}) {
    SCOPED_TRACE(words[0] + " " + words[1]);
    Ods ods(words);
    EXPECT_NE(ods.finish(), 1) << ods.err;
    for (const char byte : {'\x1b', '\x9b', '\x7f', '\r'}) {
      EXPECT_EQ(ods.out.find(byte), std::string::npos) << ods.out;
      EXPECT_EQ(ods.err.find(byte), std::string::npos) << ods.err;
    }
  }
}

// Frames that lie in the mounted folder itself, which is the current one unless --mount names another.
TEST_F(HostileFiles, FramesInTheMountedFolderAreSent) {
  for (int frame = 1; frame <= 4; frame++) make_picture(fmt::format("shot_360_TB.000{}.png", frame), "--width 16");
  const Ran ran = shell(
      "ods submit --to kubernetes -o farm --cpus 2 --chunk 2 -- convert 'shot_360_TB.####.png' "
      "-o 'cubes.####.png' --to cube-3x2");
  EXPECT_EQ(ran.code, 0) << ran.out;
  EXPECT_TRUE(std::filesystem::exists(folder.path("farm/submit.sh")));
}

}  // namespace ods::hostile_files_test
