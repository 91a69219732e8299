// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The house rules of ARCHITECTURE.md, read off the sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace {

namespace fs = std::filesystem;
using ods::source_folder;

// Libraries that few .cpp hide from all the others, by how their headers start.
const std::set<std::string> kAvFiles = {"ods/video/decode.cpp",       "ods/video/encode.cpp",
                                        "ods/video/tracks/av.cpp",    "ods/video/tracks/kept_tracks.cpp",
                                        "ods/video/tracks/sound.cpp", "ods/video/tracks/text_track.cpp"};
// Those that only open files.
const std::set<std::string> kFormatFiles = [] {
  std::set<std::string> files = kAvFiles;
  files.insert("ods/video/tracks/kept_tags.cpp");
  return files;
}();
const std::map<std::string, std::set<std::string>> kHidden = {
    {"embree", {"ods/render/cpu/embree_scene.cpp"}},
    {"CLI/", {"cli/console/options.cpp"}},
    {"OpenEXR/", {"ods/image/codec/exr.cpp", "ods/image/codec/exr_rows.cpp"}},
    {"png.h", {"ods/image/codec/png.cpp"}},
    {"jpeglib.h", {"ods/image/codec/jpeg.cpp"}},
    {"tiffio.h",
     {"ods/image/codec/tiff_reader.cpp", "ods/image/codec/tiff_stream.cpp", "ods/image/codec/tiff_writer.cpp"}},
    {"webp/", {"ods/image/codec/webp.cpp"}},
    {"libheif/", {"ods/image/codec/heif.cpp"}},
    {"libdeflate.h",
     {"ods/base/checksum.cpp", "ods/base/gzip.cpp", "ods/image/color_tags.cpp", "ods/image/codec/exr_rows.cpp",
      "ods/image/codec/tiff_writer.cpp", "ods/video/container/mesh_box.cpp"}},
    {"zstd.h", {"ods/image/ktx2/ktx2.cpp"}},
    {"draco/", {"ods/scene/gltf/draco.cpp"}},
    {"meshoptimizer.h", {"ods/scene/gltf/meshopt.cpp"}},
    {"zip.h", {"ods/files/zip_archive.cpp"}},
    {"openssl/", {"cli/http/certificate.cpp", "cli/http/web_stream.cpp"}},
    {"qrencode.h", {"cli/view/qr_code.cpp"}},
    {"lcms2", {"ods/image/icc_profile.cpp"}},
    {"libavcodec/", kAvFiles},
    {"libavformat/", kFormatFiles},
    {"libavutil/", kAvFiles},
    {"libswresample/", {"ods/video/tracks/av.cpp", "ods/video/tracks/sound.cpp"}},
    {"fontconfig/", {"ods/compose/lettering.cpp"}},
    {"pango/", {"ods/compose/lettering.cpp"}}};

// Libraries that any .cpp may know, and the system.
const std::set<std::string> kShared = {"fmt/",      "glm/",     "nlohmann/", "tbb/",   "dirent.h", "dlfcn.h",
                                       "fcntl.h",   "malloc.h", "signal.h",  "sys/",   "unistd.h", "arpa/",
                                       "ifaddrs.h", "net/",     "netinet/",  "spawn.h"};

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
  const fs::path root = source_folder();
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

struct Room {
  std::string path;                // "ods/image/format"
  std::set<std::string> includes;  // paths, too
};

// The words of a row of a table in Markdown: "| a | b |".
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream row(line.substr(1));
  for (std::string cell; std::getline(row, cell, '|');) {
    const size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }
  return cells;
}

// The table of tests/rooms.md, in its order.
std::vector<Room> read_rooms() {
  std::vector<Room> rooms;
  for (const std::string& line : read_lines(fs::path(source_folder()) / "tests/rooms.md")) {
    if (!line.starts_with("| ods/") && !line.starts_with("| cli/")) continue;
    const std::vector<std::string> cells = cells_of(line);
    Room& room = rooms.emplace_back(Room{cells.at(0), {}});
    std::istringstream names(std::regex_replace(cells.at(2), std::regex(","), " "));
    for (std::string name; names >> name;) room.includes.insert(name.starts_with("cli/") ? name : "ods/" + name);
  }
  EXPECT_GT(rooms.size(), 10u);
  return rooms;
}

// Which storey of ARCHITECTURE.md a folder is in.
std::map<std::string, int> read_storeys() {
  std::map<std::string, int> storeys;
  for (const std::string& line : read_lines(fs::path(source_folder()) / "ARCHITECTURE.md")) {
    if (line.size() < 4 || !line.starts_with("| ") || !std::isdigit(static_cast<unsigned char>(line[2]))) continue;
    const std::vector<std::string> cells = cells_of(line);
    std::istringstream names(std::regex_replace(cells.at(2), std::regex("`"), " "));
    for (std::string name; names >> name;) storeys[name] = std::stoi(cells.at(0));
  }
  EXPECT_GT(storeys.size(), 10u);
  return storeys;
}

// 0: it is in none.
int storey_of(const std::map<std::string, int>& storeys, std::string room) {
  for (; !storeys.contains(room); room.resize(room.rfind('/'))) {
    if (room.find('/') == std::string::npos) return 0;
  }
  return storeys.at(room);
}

// The room of a file: the longest path of one that it lies in.
std::string room_of(const std::vector<Room>& rooms, const std::string& file) {
  std::string found;
  for (const Room& room : rooms) {
    if (file.starts_with(room.path + "/") && room.path.size() > found.size()) found = room.path;
  }
  return found;
}

TEST(House, EveryRoomIncludesOnlyStoreysBelow) {
  const std::map<std::string, int> storeys = read_storeys();
  const std::vector<Room> rooms = read_rooms();
  for (const Room& room : rooms) {
    const int own = storey_of(storeys, room.path);
    EXPECT_GT(own, 0) << room.path << " is in no storey of ARCHITECTURE.md";
    for (const std::string& other : room.includes)
      EXPECT_LE(storey_of(storeys, other), own) << room.path << ", " << other;
  }
  for (const auto& [folder, storey] : storeys) EXPECT_TRUE(fs::exists(fs::path(source_folder()) / folder)) << folder;
}

TEST(House, EveryRoomIncludesWhatTheTableSays) {
  const std::vector<Room> rooms = read_rooms();
  std::map<std::string, std::set<std::string>> included_rooms;
  for (const Source& source : read_sources({"ods", "cli"})) {
    const std::string own = room_of(rooms, source.path);
    if (source.path == "cli/main.cpp") continue;  // the door of all rooms
    ASSERT_FALSE(own.empty()) << source.path << " is in no room of tests/rooms.md";
    for (const std::string& line : source.lines) {
      const std::string header = included(line, '"', '"');
      if (!header.empty() && room_of(rooms, header) != own) included_rooms[own].insert(room_of(rooms, header));
    }
  }
  for (const Room& room : rooms) EXPECT_EQ(included_rooms[room.path], room.includes) << room.path;
}

TEST(House, EveryRoomIncludesOnlyRoomsAboveIt) {
  std::set<std::string> above;
  for (const Room& room : read_rooms()) {
    for (const std::string& other : room.includes) {
      EXPECT_TRUE(above.contains(other)) << room.path << " includes " << other << ", which does not stand above it";
    }
    above.insert(room.path);
  }
}

TEST(House, RoomsAreSmall) {
  const std::vector<Room> rooms = read_rooms();
  std::map<std::string, int> sizes;
  for (const Source& source : read_sources({"ods", "cli"})) sizes[room_of(rooms, source.path)]++;
  for (const auto& [room, size] : sizes) EXPECT_LE(size, room == "ods/base" ? 40 : 25) << room;
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

// What starts another program limits its time, and ends it with us.
TEST(House, OneFileStartsPrograms) {
  const std::set<std::string> own = {"cli/console/programs.cpp", "cli/console/supervisor.cpp"};
  for (const Source& source : all_sources()) {
    const bool is_ours = source.path.starts_with("ods/") || source.path.starts_with("cli/");
    if (!is_ours || own.contains(source.path)) continue;
    for (const std::string& line : source.lines) {
      for (const char* word : {"posix_spawn", " fork(", "popen(", "std::system(", "execv"}) {
        EXPECT_EQ(line.find(word), std::string::npos) << source.path << ": " << line;
      }
    }
  }
}

// The library's users have settings, `layout`; --layout is the command's (with_options() in cli/console/console.h). A
// farm's tasks and exports are command lines by nature.
TEST(House, TheLibraryNamesNoOption) {
  static const std::regex option("\"(?:[^\"\\\\]|\\\\.)*(^|[^A-Za-z0-9-])--[a-z]");
  for (const Source& source : read_sources({"ods"})) {
    if (source.path.starts_with("ods/farm/") || source.path.starts_with("ods/export/")) continue;
    for (const std::string& line : source.lines) {
      const bool is_comment = line.find_first_not_of(' ') == line.find("//");
      EXPECT_TRUE(is_comment || !std::regex_search(line, option)) << source.path << ": " << line;
    }
  }
}

TEST(House, FilesAreSmall) {
  size_t commands = 0;
  for (const Source& source : all_sources()) {
    EXPECT_LE(source.lines.size(), 500u) << source.path;
    const bool front_door =
        source.is_header() && source.path.starts_with("ods/") && !source.path.starts_with("ods/kernel");
    EXPECT_TRUE(!front_door || source.lines.size() <= 200) << source.path;
    const bool command = source.path.starts_with("cli/") &&
                         std::any_of(source.lines.begin(), source.lines.end(), [](const std::string& line) {
                           return line.starts_with("int ods_") && line.ends_with("{");
                         });
    commands += command ? 1 : 0;
    EXPECT_TRUE(!command || source.lines.size() <= 150) << source.path;
  }
  EXPECT_GT(commands, 15u);
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

TEST(House, TheBuildIsShort) {
  const fs::path root = source_folder();
  size_t total = read_lines(root / "CMakeLists.txt").size();
  for (const char* folder : {"cmake", "examples", "tests"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(root / folder)) {
      const fs::path& file = entry.path();
      if (file.filename() == "CMakeLists.txt" || file.extension() == ".cmake") total += read_lines(file).size();
    }
  }
  EXPECT_LE(total, 335u);
}

// Whoever changes ods/ROOM/NAME finds its test, if it has one of its own, as tests/ROOM/NAME_test.cpp.
TEST(House, TestsStandWhereTheirSourcesDo) {
  std::map<std::string, std::set<std::string>> folders;  // of a source's name
  for (const Source& source : read_sources({"ods"})) {
    const fs::path path = fs::path(source.path).lexically_relative("ods");
    folders[path.stem().native()].insert(path.parent_path().generic_string());
  }
  for (const Source& source : read_sources({"tests"})) {
    const fs::path path = fs::path(source.path).lexically_relative("tests");
    std::string name = path.stem().native();
    if (!name.ends_with("_test")) continue;
    name.resize(name.size() - 5);
    const std::string folder = path.parent_path().generic_string();
    EXPECT_TRUE(!folders.contains(name) || folder == "cli" || folder == "peers" || folders[name].contains(folder))
        << source.path;
  }
}

// NAME and ROOM stand for any.
TEST(House, PathsThatThePagesNameExist) {
  const fs::path root = source_folder();
  std::vector<fs::path> pages = {root / "README.md", root / "ARCHITECTURE.md", root / "CONTRIBUTING.md"};
  for (const fs::directory_entry& entry : fs::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  const std::regex path("`((ods|cli|web|tests|docs|bench|fuzz|examples|cmake)/[A-Za-z0-9_/.-]+)`");
  size_t found = 0;
  for (const fs::path& page : pages) {
    for (const std::string& line : read_lines(page)) {
      for (std::sregex_iterator match(line.begin(), line.end(), path), end; match != end; ++match) {
        const std::string name = (*match)[1].str();
        if (name.find("NAME") != std::string::npos || name.find("ROOM") != std::string::npos) continue;
        found++;
        EXPECT_TRUE(fs::exists(root / name)) << page.filename() << " names " << name;
      }
    }
  }
  EXPECT_GT(found, 30u);
}

// The files that a row of CONTRIBUTING.md's recipes names by their whole paths.
std::set<std::string> files_of_recipe(const std::string& name) {
  const std::regex path("`((ods|cli|web|tests|docs)/[A-Za-z0-9_/.-]+)`");
  std::set<std::string> files;
  for (const std::string& line : read_lines(fs::path(source_folder()) / "CONTRIBUTING.md")) {
    if (!line.starts_with("| " + name + " |")) continue;
    for (std::sregex_iterator match(line.begin(), line.end(), path), end; match != end; ++match) {
      files.insert((*match)[1].str());
    }
  }
  EXPECT_FALSE(files.empty()) << name;
  return files;
}

// The files that speak of a member of a closed set, by its name in the code or by the word of the command line.
std::set<std::string> files_that_name(const std::string& member, const std::string& word) {
  const std::regex either("(^|[^A-Za-z0-9_])" + member + "($|[^A-Za-z0-9_])|(^|[^A-Za-z0-9_])" + word +
                          "($|[^A-Za-z0-9_])");
  const fs::path root = source_folder();
  std::set<std::string> files;
  for (const char* folder : {"ods", "cli", "web", "tests", "docs"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::set<std::string> texts = {".cpp", ".h", ".md", ".sh", ".glsl", ".frag", ".js", ".html"};
      const std::string path = fs::relative(entry.path(), root).generic_string();
      if (!texts.contains(entry.path().extension()) || path == "tests/house_test.cpp" || path.starts_with("tests/web/"))
        continue;
      for (const std::string& line : read_lines(entry.path())) {
        if (line.find(member) == std::string::npos && line.find(word) == std::string::npos) continue;
        if (std::regex_search(line, either)) files.insert(path);
      }
    }
  }
  return files;
}

// Each of these was added by its recipe: the recipe names the files that know of it, all of them and no other.
TEST(House, RecipesNameTheFilesThatAMemberTouches) {
  struct Added {
    const char* recipe;
    const char* member;
    const char* word;
  };
  for (const Added& added : {Added{"a projection", "kFisheyeStereographic", "fisheye-stereographic"},
                             Added{"a name for a projection with other defaults", "mirror-ball", "mirror-ball"},
                             Added{"a pole merge", "kMergeSmootherstep", "smootherstep"},
                             Added{"a layout of the eyes", "kColumnInterleaved", "column-interleaved"}}) {
    EXPECT_EQ(files_that_name(added.member, added.word), files_of_recipe(added.recipe)) << added.recipe;
  }
}

// Recipes give the names of some files without their folders. Every row names a file, or the row before it.
TEST(House, FilesThatRecipesNameExist) {
  std::set<std::string> names;
  for (const Source& source : all_sources()) names.insert(fs::path(source.path).filename());
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(source_folder()) / "web")) {
    names.insert(entry.path().filename());
  }
  const std::regex file("`([a-z0-9_]+\\.(cpp|h|js|html|css|sh|py))`"), any("`[^`]+/[^`]*`|that, and");
  size_t rows = 0;
  for (const std::string& line : read_lines(fs::path(source_folder()) / "CONTRIBUTING.md")) {
    const bool row = line.starts_with("| a") || line.starts_with("| some");
    rows += row ? 1 : 0;
    EXPECT_TRUE(!row || std::regex_search(line, any)) << line;
    for (std::sregex_iterator match(line.begin(), line.end(), file), end; match != end; ++match) {
      EXPECT_TRUE(names.contains((*match)[1].str())) << (*match)[1].str();
    }
  }
  EXPECT_GT(rows, 30u);
}

}  // namespace
