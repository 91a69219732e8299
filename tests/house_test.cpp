// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The house rules of ARCHITECTURE.md, read off the sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

// What the sources of a folder may include beside their own folder.
const std::map<std::string, std::set<std::string>> kArrows = {
    {"ods/kernel", {}},
    {"ods/base", {"ods/kernel"}},
    {"ods/image", {"ods/kernel", "ods/base"}},
    {"ods/video", {"ods/kernel", "ods/base", "ods/image"}},
    {"ods/stitch", {"ods/kernel", "ods/base", "ods/image"}},
    {"ods/scene", {"ods/kernel", "ods/base", "ods/image"}},
    {"ods/cpu", {"ods/kernel", "ods/base", "ods/image", "ods/scene"}},
    {"cli", {"ods/kernel", "ods/base", "ods/image", "ods/video", "ods/stitch", "ods/scene", "ods/cpu"}},
};

// Libraries that few .cpp hide from all the others, by how their headers start.
const std::set<std::string> kAvFiles = {"ods/video/av.cpp", "ods/video/decode.cpp", "ods/video/encode.cpp",
                                        "ods/video/sound.cpp"};
const std::map<std::string, std::set<std::string>> kHidden = {
    {"OpenImageIO/", {"ods/image/image_file.cpp", "ods/image/image_writer.cpp"}},
    {"embree", {"ods/cpu/embree_scene.cpp"}},
    {"CLI/", {"cli/options.cpp"}},
    {"OpenEXR/", {"ods/image/exr_rows.cpp"}},
    {"libdeflate.h", {"ods/base/checksum.cpp", "ods/image/color_tags.cpp", "ods/image/exr_rows.cpp"}},
    {"lcms2", {"ods/image/icc_profile.cpp"}},
    {"libavcodec/", kAvFiles},
    {"libavformat/", kAvFiles},
    {"libavutil/", kAvFiles},
    {"libswresample/", {"ods/video/av.cpp", "ods/video/sound.cpp"}},
    {"fontconfig/", {"ods/image/lettering.cpp"}},
    {"pango/", {"ods/image/lettering.cpp"}}};

// Libraries that any .cpp may know, and the system.
const std::set<std::string> kShared = {"fmt/",    "glm/",     "nlohmann/", "tbb/",    "dlfcn.h",
                                       "fcntl.h", "signal.h", "sys/",      "unistd.h"};

struct Source {
  std::string path;  // from the root of the tree
  std::vector<std::string> lines;
  bool is_header() const { return path.ends_with(".h"); }
};

std::vector<std::string> read_lines(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<Source> read_sources(const std::vector<std::string>& folders) {
  const fs::path root = ODS_SOURCE_DIR;
  std::vector<Source> sources;
  for (const std::string& folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".h") continue;
      sources.push_back({fs::relative(entry.path(), root).generic_string(), read_lines(entry.path())});
    }
  }
  EXPECT_GT(sources.size(), 10u);
  return sources;
}

const std::vector<Source>& all_sources() {
  static const std::vector<Source> sources = read_sources({"ods", "cli", "tests", "bench", "fuzz", "examples"});
  return sources;
}

// What stands between the marks of a line `#include "..."` or `#include <...>`; empty for every other line.
std::string included(const std::string& line, char open, char close) {
  const std::string start = std::string("#include ") + open;
  if (!line.starts_with(start)) return "";
  return line.substr(start.size(), line.find(close, start.size()) - start.size());
}

// "ods/image" of "ods/image/save.h", "cli" of "cli/render.cpp".
std::string folder_of(const std::string& path) {
  const size_t from = path.starts_with("ods/") ? 4 : 0;
  return path.substr(0, path.find('/', from));
}

TEST(House, IncludesFollowTheArrows) {
  for (const Source& source : read_sources({"ods", "cli"})) {
    const std::string own = folder_of(source.path);
    ASSERT_TRUE(kArrows.contains(own)) << source.path << ": say in kArrows what this folder may include";
    for (const std::string& line : source.lines) {
      const std::string header = included(line, '"', '"');
      if (header.empty()) continue;
      EXPECT_TRUE(folder_of(header) == own || kArrows.at(own).contains(folder_of(header)))
          << source.path << " may not include " << header;
    }
  }
}

TEST(House, HeadersShowNoLibraryButGlm) {
  for (const Source& source : read_sources({"ods", "cli"})) {
    if (!source.is_header()) continue;
    for (const std::string& line : source.lines) {
      const std::string header = included(line, '<', '>');
      const bool standard = header.find_first_of("./") == std::string::npos;
      const bool names_only = header.ends_with("_fwd.hpp");
      EXPECT_TRUE(standard || names_only || header.starts_with("glm/"))
          << source.path << " includes <" << header << ">";
    }
  }
}

TEST(House, FewFilesKnowALibrary) {
  for (const auto& [library, known] : kHidden) {
    std::set<std::string> who;
    for (const Source& source : read_sources({"ods", "cli"})) {
      for (const std::string& line : source.lines) {
        if (included(line, '<', '>').starts_with(library)) who.insert(source.path);
      }
    }
    EXPECT_EQ(who, known) << library;
  }
}

// A library that is missing in both lists would be known to whoever likes.
TEST(House, EveryLibraryIsListed) {
  for (const Source& source : read_sources({"ods", "cli"})) {
    for (const std::string& line : source.lines) {
      const std::string header = included(line, '<', '>');
      if (header.find_first_of("./") == std::string::npos) continue;  // the standard library
      const auto starts = [&](const auto& entry) { return header.starts_with(entry); };
      const bool hidden =
          std::any_of(kHidden.begin(), kHidden.end(), [&](const auto& each) { return starts(each.first); });
      EXPECT_TRUE(hidden || std::any_of(kShared.begin(), kShared.end(), starts))
          << source.path << " includes <" << header << ">: name its library in kHidden or kShared";
    }
  }
}

// The name of the type that a line defines at the outermost level; empty for every other line.
std::string defined_type(const std::string& line) {
  static const std::regex type("^(struct|class|enum|enum class|union) ([A-Za-z]+)( final)?( *:[^:].*)? ?[{].*");
  std::smatch match;
  return std::regex_match(line, match, type) ? match[2].str() : "";
}

// Two types of one name in namespace ods are one type to the linker, which keeps the members of either.
TEST(House, TypesHaveOneDefinition) {
  std::map<std::string, std::string> where;  // of headers' types
  for (const Source& source : read_sources({"ods", "cli"})) {
    std::string space;  // the innermost named namespace
    bool anonymous = false;
    for (const std::string& line : source.lines) {
      if (line == "namespace {" || line == "}  // namespace") anonymous = line == "namespace {";
      if (line.starts_with("namespace ") && line.ends_with(" {")) space = line;
      const std::string name = defined_type(line);
      if (name.empty() || anonymous) continue;
      if (!source.is_header()) {
        ADD_FAILURE() << source.path << ": " << name << " is known to this file alone: put it into namespace {}";
      } else {
        const auto [other, is_new] = where.emplace(space + name, source.path);
        EXPECT_TRUE(is_new) << name << " is defined in " << other->second << " and in " << source.path;
      }
    }
  }
}

TEST(House, FilesAreSmall) {
  for (const Source& source : all_sources()) {
    EXPECT_LE(source.lines.size(), 500u) << source.path;
    const bool front_door =
        source.is_header() && source.path.starts_with("ods/") && !source.path.starts_with("ods/kernel");
    EXPECT_TRUE(!front_door || source.lines.size() <= 200) << source.path;
    const bool command = std::any_of(source.lines.begin(), source.lines.end(),
                                     [](const std::string& line) { return line.starts_with("extern \"C\" int ods_"); });
    EXPECT_TRUE(!command || source.lines.size() <= 150) << source.path;
  }
}

TEST(House, FunctionsAreSmall) {
  const std::regex no_function("^(namespace|struct|class|enum|union|extern|#|\\}|//| ).*|.*= \\{+");
  for (const Source& source : all_sources()) {
    size_t start = 0;  // the line number of the function that is open, from 1
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string& line = source.lines[i];
      if (line.ends_with("{") && !std::regex_match(line, no_function)) start = i + 1;
      if (start == 0 || !line.starts_with("}")) continue;
      EXPECT_LE(i + 2 - start, 62u) << source.path << ":" << start;
      start = 0;
    }
  }
}

TEST(House, EveryFileSaysItsLicense) {
  for (const Source& source : all_sources()) {
    ASSERT_GE(source.lines.size(), 2u) << source.path;
    EXPECT_EQ(source.lines[0], "// SPDX-FileCopyrightText: 2026 The Omnistereo authors") << source.path;
    EXPECT_EQ(source.lines[1], "// SPDX-License-Identifier: Apache-2.0") << source.path;
  }
}

TEST(House, EverySourceIsListedAndTheListIsShort) {
  const fs::path root = ODS_SOURCE_DIR;
  size_t total = 0;
  std::set<std::string> words;
  for (const char* name : {"CMakeLists.txt", "cmake", "examples", "tests"}) {
    std::vector<fs::path> files;
    if (fs::is_directory(root / name)) {
      for (const fs::directory_entry& entry : fs::directory_iterator(root / name)) files.push_back(entry.path());
    } else {
      files.push_back(root / name);
    }
    for (const fs::path& file : files) {
      if (file.filename() != "CMakeLists.txt" && file.extension() != ".cmake") continue;
      const std::vector<std::string> lines = read_lines(file);
      total += lines.size();
      for (const std::string& line : lines) {
        std::istringstream stream(std::regex_replace(line, std::regex("[()]"), " "));
        for (std::string word; stream >> word;) words.insert(word);
      }
    }
  }
  EXPECT_LE(total, 320u);
  for (const Source& source : read_sources({"ods", "cli", "tests", "bench", "fuzz"})) {
    const std::regex program("(tests|bench)/(.*)_(test|bench).cpp");
    const std::string name = std::regex_replace(source.path, program, "$2");
    const bool listed = words.contains(source.path) || words.contains(name);
    EXPECT_TRUE(source.is_header() || listed) << source.path << " is not built";
  }
}

TEST(House, ArchitectureNamesEveryRoom) {
  std::string text;
  for (const std::string& line : read_lines(fs::path(ODS_SOURCE_DIR) / "ARCHITECTURE.md")) text += line + "\n";
  for (const auto& [folder, sees] : kArrows) {
    const std::string name = folder.substr(folder.find('/') + 1) + "/";
    EXPECT_NE(text.find(name), std::string::npos) << "ARCHITECTURE.md does not explain " << folder;
  }
}

}  // namespace
