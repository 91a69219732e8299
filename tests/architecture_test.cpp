// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks the sources against the rules and tables of ARCHITECTURE.md.
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
#include "tests/support/sources.h"

namespace {

namespace fs = std::filesystem;
using ods::all_sources, ods::read_lines, ods::read_sources, ods::Source, ods::source_folder;

// Libraries that few .cpp hide from all the others, by how their headers start.
const std::set<std::string> kAvFiles = {"ods/video/decode.cpp",       "ods/video/encode.cpp",
                                        "ods/video/tracks/av.cpp",    "ods/video/tracks/kept_tracks.cpp",
                                        "ods/video/tracks/sound.cpp", "ods/video/tracks/text_track.cpp"};
// Libraries that only open files.
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
     {"ods/base/checksum.cpp", "ods/base/gzip.cpp", "ods/image/codec/exr_rows.cpp", "ods/image/codec/tiff_writer.cpp",
      "ods/image/format/inflate.cpp", "ods/video/container/mesh_box.cpp"}},
    {"zstd.h", {"ods/image/codec/ktx2.cpp"}},
    {"draco/", {"ods/scene/gltf/draco.cpp"}},
    {"meshoptimizer.h", {"ods/layers/simplify.cpp", "ods/scene/gltf/meshopt.cpp"}},
    {"zip.h", {"ods/files/zip_archive.cpp"}},
    {"openssl/", {"cli/http/certificate.cpp", "cli/http/web_stream.cpp"}},
    {"qrencode.h", {"cli/view/qr_code.cpp"}},
    {"lcms2", {"ods/image/icc_profile.cpp"}},
    {"libavcodec/", kAvFiles},
    {"libavformat/", kFormatFiles},
    {"libavutil/", kAvFiles},
    {"libswresample/", {"ods/video/tracks/av.cpp", "ods/video/tracks/sound.cpp"}},
    {"fontconfig/", {"ods/compose/lettering.cpp"}},
    {"pango/", {"ods/compose/lettering.cpp"}},
    {"vulkan/", {"ods/render/gpu/loader.h"}}};

// The one header that shows a library, to the .cpp files of its folder.
const std::string kShowsVulkan = "ods/render/gpu/loader.h";

// Libraries that any .cpp may use, and the system.
const std::set<std::string> kShared = {"fmt/",      "glm/",     "nlohmann/", "tbb/",  "dirent.h", "dlfcn.h",
                                       "fcntl.h",   "malloc.h", "signal.h",  "sys/",  "unistd.h", "arpa/",
                                       "ifaddrs.h", "net/",     "netinet/",  "pwd.h", "spawn.h"};

// Returns the name in a line `#include "..."` or `#include <...>`; empty for every other line.
std::string included(const std::string& line, char open, char close) {
  const std::string start = std::string("#include ") + open;
  if (!line.starts_with(start)) return "";
  return line.substr(start.size(), line.find(close, start.size()) - start.size());
}

struct Module {
  std::string path;                // "ods/image/format"
  std::set<std::string> includes;  // paths, too
};

// The cells of a row of a table in Markdown: "| a | b |".
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream row(line.substr(1));
  for (std::string cell; std::getline(row, cell, '|');) {
    const size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }
  return cells;
}

// The table of modules in ARCHITECTURE.md, in its order.
std::vector<Module> read_modules() {
  std::vector<Module> modules;
  for (const std::string& line : read_lines(fs::path(source_folder()) / "ARCHITECTURE.md")) {
    if (!line.starts_with("| ods/") && !line.starts_with("| cli/")) continue;
    const std::vector<std::string> cells = cells_of(line);
    Module& module = modules.emplace_back(Module{cells.at(0), {}});
    std::istringstream names(std::regex_replace(cells.at(2), std::regex(","), " "));
    for (std::string name; names >> name;) module.includes.insert(name.starts_with("cli/") ? name : "ods/" + name);
  }
  EXPECT_GT(modules.size(), 10u);
  return modules;
}

// The layers of the folders in ARCHITECTURE.md.
std::map<std::string, int> read_layers() {
  std::map<std::string, int> layers;
  for (const std::string& line : read_lines(fs::path(source_folder()) / "ARCHITECTURE.md")) {
    if (line.size() < 4 || !line.starts_with("| ") || !std::isdigit(static_cast<unsigned char>(line[2]))) continue;
    const std::vector<std::string> cells = cells_of(line);
    std::istringstream names(std::regex_replace(cells.at(2), std::regex("`"), " "));
    for (std::string name; names >> name;) layers[name] = std::stoi(cells.at(0));
  }
  EXPECT_GT(layers.size(), 10u);
  return layers;
}

// Returns 0 if the module is not in any layer.
int layer_of(const std::map<std::string, int>& layers, std::string module) {
  for (; !layers.contains(module); module.resize(module.rfind('/'))) {
    if (module.find('/') == std::string::npos) return 0;
  }
  return layers.at(module);
}

// Returns the module with the longest path that contains the file.
std::string module_of(const std::vector<Module>& modules, const std::string& file) {
  std::string found;
  for (const Module& module : modules) {
    if (file.starts_with(module.path + "/") && module.path.size() > found.size()) found = module.path;
  }
  return found;
}

TEST(Architecture, ModulesIncludeOnlyLayersBelow) {
  const std::map<std::string, int> layers = read_layers();
  const std::vector<Module> modules = read_modules();
  for (const Module& module : modules) {
    const int own = layer_of(layers, module.path);
    EXPECT_GT(own, 0) << module.path << " is not in any layer of ARCHITECTURE.md";
    for (const std::string& other : module.includes)
      EXPECT_LE(layer_of(layers, other), own) << module.path << ", " << other;
  }
  for (const auto& [folder, layer] : layers) EXPECT_TRUE(fs::exists(fs::path(source_folder()) / folder)) << folder;
}

TEST(Architecture, ModulesIncludeWhatTheTableLists) {
  const std::vector<Module> modules = read_modules();
  std::map<std::string, std::set<std::string>> included_modules;
  for (const Source& source : read_sources({"ods", "cli"})) {
    const std::string own = module_of(modules, source.path);
    if (source.path == "cli/main.cpp" || source.path == "cli/commands.cpp") continue;  // above all modules
    ASSERT_FALSE(own.empty()) << source.path << " is not in any module of ARCHITECTURE.md";
    for (const std::string& line : source.lines) {
      const std::string header = included(line, '"', '"');
      if (!header.empty() && module_of(modules, header) != own)
        included_modules[own].insert(module_of(modules, header));
    }
  }
  for (const Module& module : modules) EXPECT_EQ(included_modules[module.path], module.includes) << module.path;
}

TEST(Architecture, ModulesIncludeOnlyRowsAbove) {
  std::set<std::string> above;
  for (const Module& module : read_modules()) {
    for (const std::string& other : module.includes) {
      EXPECT_TRUE(above.contains(other)) << module.path << " includes " << other
                                         << ", which is not above it in the table";
    }
    above.insert(module.path);
  }
}

TEST(Architecture, ModulesAreSmall) {
  const std::vector<Module> modules = read_modules();
  std::map<std::string, int> sizes;
  for (const Source& source : read_sources({"ods", "cli"})) sizes[module_of(modules, source.path)]++;
  for (const auto& [module, size] : sizes) EXPECT_LE(size, module == "ods/base" ? 40 : 30) << module;
}

TEST(Architecture, HeadersShowNoLibraryButGlm) {
  for (const Source& source : read_sources({"ods", "cli"})) {
    for (const std::string& line : source.lines) {
      const bool is_of_its_folder = source.path.starts_with("ods/render/gpu/") && !source.is_header();
      EXPECT_TRUE(is_of_its_folder || included(line, '"', '"') != kShowsVulkan) << source.path;
    }
    if (!source.is_header() || source.path == kShowsVulkan) continue;
    for (const std::string& line : source.lines) {
      const std::string header = included(line, '<', '>');
      const bool standard = header.find_first_of("./") == std::string::npos;
      const bool names_only = header.ends_with("_fwd.hpp");
      EXPECT_TRUE(standard || names_only || header.starts_with("glm/"))
          << source.path << " includes <" << header << ">";
    }
  }
}

TEST(Architecture, FewFilesKnowALibrary) {
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

// A library that is missing in both lists could be used everywhere.
TEST(Architecture, EveryLibraryIsListed) {
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
TEST(Architecture, TypesHaveOneDefinition) {
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

// Code that starts another program limits its time, and ends it with us.
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
TEST(Architecture, TheLibraryNamesNoOption) {
  static const std::regex option("\"(?:[^\"\\\\]|\\\\.)*(^|[^A-Za-z0-9-])--[a-z]");
  for (const Source& source : read_sources({"ods"})) {
    if (source.path.starts_with("ods/farm/") || source.path.starts_with("ods/export/")) continue;
    for (const std::string& line : source.lines) {
      const bool is_comment = line.find_first_not_of(' ') == line.find("//");
      EXPECT_TRUE(is_comment || !std::regex_search(line, option)) << source.path << ": " << line;
    }
  }
}

// Fails if one of these begins a word in code, not in a comment, except in these files.
void expect_only_in(const std::vector<std::string>& folders, const std::vector<std::string>& starts,
                    const std::set<std::string>& allowed, const std::string& instead) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (const Source& source : read_sources(folders)) {
    if (allowed.contains(source.path)) continue;
    for (const std::string& line : source.lines) {
      for (const std::string& start : starts) {
        const size_t at = line.find(start);
        if (at == std::string::npos || line.find("// ") < at) continue;
        const bool is_within_word = at > 0 && is_letter(line[at - 1]) && is_letter(start[0]);
        EXPECT_TRUE(is_within_word) << source.path << ": " << line << "\n" << instead;
      }
    }
  }
}

// If the name of a file in a shared folder can be guessed, another user can put a link there first.
TEST(Architecture, OnlyPrivateFoldersAreInTheTemporaryFolder) {
  expect_only_in({"ods", "cli", "tests"}, {"/tmp", "temp_directory_path", "tmpnam", "tmpfile", "mkstemp", "mkdtemp"},
                 {"ods/files/private_folder.cpp", "ods/files/atomic_folder.cpp", "tests/support/temporary_folder.h",
                  "tests/architecture_test.cpp", "tests/cli/view/studio_test.cpp"},
                 "ods/files/private_folder.h makes one; encoders write to memory");
  // These have it in names beside the output, in a claim's text, and to compare it.
  expect_only_in({"ods", "cli"}, {"getpid"},
                 {"ods/files/private_folder.cpp", "ods/files/atomic_file.cpp", "ods/files/claim.cpp",
                  "cli/console/supervisor.cpp"},
                 "a process's number makes no name that cannot be guessed");
}

// Texts of files hold control characters.
TEST(Architecture, TextReachesTheTerminalOneWay) {
  expect_only_in({"cli"},
                 {"printf(", "fprintf(", "puts(", "fputs(", "fwrite(", "putc(", "fputc(", "putchar(", "fmt::print",
                  "std::print", "std::cout", "std::cerr", "std::clog"},
                 {"cli/console/print.cpp", "cli/console/long_job.cpp"}, "cli/console/print.h has the functions");
  // A bundle is ASCII, a .glb is not for terminals, and the error without memory is prepared while there is some.
  expect_only_in({"ods", "cli"}, {".dump(", "->dump("},
                 {"ods/base/quote.cpp", "ods/view/bundle.cpp", "cli/bridge/assimp.cpp", "cli/console/console.cpp"},
                 "json_document() writes JSON");
  // The other reads it.
  expect_only_in({"ods", "cli"}, {"&lt;"}, {"ods/base/quote.cpp", "ods/image/format/xmp.cpp"}, "xml_text() writes XML");
}

TEST(Architecture, FilesAreSmall) {
  size_t commands = 0;
  for (const Source& source : all_sources()) {
    EXPECT_LE(source.lines.size(), 500u) << source.path;
    const bool public_header =
        source.is_header() && source.path.starts_with("ods/") && !source.path.starts_with("ods/kernel");
    EXPECT_TRUE(!public_header || source.lines.size() <= 200) << source.path;
    const bool command = source.path.starts_with("cli/") &&
                         std::any_of(source.lines.begin(), source.lines.end(), [](const std::string& line) {
                           return line.starts_with("extern const Command k");
                         });
    commands += command ? 1 : 0;
    EXPECT_TRUE(!command || source.lines.size() <= 150) << source.path;
  }
  EXPECT_GT(commands, 15u);
}

TEST(Architecture, EveryFileHasItsLicense) {
  for (const Source& source : all_sources()) {
    ASSERT_GE(source.lines.size(), 2u) << source.path;
    EXPECT_EQ(source.lines[0], "// SPDX-FileCopyrightText: 2026 The Omnistereo authors") << source.path;
    EXPECT_EQ(source.lines[1], "// SPDX-License-Identifier: Apache-2.0") << source.path;
  }
}

TEST(Architecture, TheBuildIsShort) {
  const fs::path root = source_folder();
  size_t total = read_lines(root / "CMakeLists.txt").size();
  for (const char* folder : {"cmake", "examples", "tests"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(root / folder)) {
      const fs::path& file = entry.path();
      if (file.filename() == "CMakeLists.txt" || file.extension() == ".cmake") total += read_lines(file).size();
    }
  }
  EXPECT_LE(total, 350u);
}

// Returns whether a name begins with one of these, followed by nothing or by "_".
bool begins_with_any(const std::string& name, const std::set<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&](const std::string& beginning) {
    return name == beginning || name.starts_with(beginning + "_");
  });
}

// The test of ods/MODULE/NAME, if it has one of its own, is tests/MODULE/NAME_test.cpp. The tests of a command or
// another file of cli/MODULE are tests/cli/MODULE/NAME_test.cpp and NAME_TOPIC_test.cpp; tests of all commands are in
// tests/cli.
TEST(Architecture, TestsAreWhereTheirSourcesAre) {
  std::map<std::string, std::set<std::string>> folders;  // of a source's name
  std::map<std::string, std::set<std::string>> names;    // of the sources in a folder
  for (const Source& source : read_sources({"ods", "cli"})) {
    const fs::path path = fs::path(source.path);
    const std::string folder = path.parent_path().generic_string();
    folders[path.stem().native()].insert(folder);
    names[folder].insert(path.stem().native());
  }
  for (const Source& source : read_sources({"tests"})) {
    const fs::path path = fs::path(source.path).lexically_relative("tests");
    std::string name = path.stem().native();
    if (!name.ends_with("_test")) continue;
    name.resize(name.size() - 5);
    const std::string folder = path.parent_path().generic_string();
    if (folder == "cli" || folder == "peers") continue;
    if (folder.starts_with("cli/")) {
      EXPECT_TRUE(begins_with_any(name, names[folder])) << source.path << " begins with no source of " << folder;
    } else {
      std::erase_if(folders[name], [](const std::string& of) { return of.starts_with("cli/"); });
      EXPECT_TRUE(folders[name].empty() || folders[name].contains("ods/" + folder))
          << source.path << " has the name of " << *folders[name].begin() << "/" << name << ": move or rename one";
    }
  }
}

// NAME and MODULE stand for any.
TEST(Architecture, PathsThatThePagesNameExist) {
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
        if (name.find("NAME") != std::string::npos || name.find("MODULE") != std::string::npos) continue;
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

// The files that mention a member of a closed set, by its name in the code or on the command line.
std::set<std::string> files_that_name(const std::string& member, const std::string& word) {
  const std::regex either("(^|[^A-Za-z0-9_])" + member + "($|[^A-Za-z0-9_])|(^|[^A-Za-z0-9_])" + word +
                          "($|[^A-Za-z0-9_])");
  const fs::path root = source_folder();
  std::set<std::string> files;
  for (const char* folder : {"ods", "cli", "web", "tests", "docs"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::set<std::string> texts = {".cpp", ".h", ".md", ".sh", ".glsl", ".frag", ".js", ".html"};
      const std::string path = fs::relative(entry.path(), root).generic_string();
      if (!texts.contains(entry.path().extension()) || path == "tests/architecture_test.cpp" ||
          path.starts_with("tests/web/"))
        continue;
      for (const std::string& line : read_lines(entry.path())) {
        if (line.find(member) == std::string::npos && line.find(word) == std::string::npos) continue;
        if (std::regex_search(line, either)) files.insert(path);
      }
    }
  }
  return files;
}

// Each of these was added by its recipe: the recipe names exactly the files that mention it.
TEST(Architecture, RecipesNameTheFilesThatAMemberTouches) {
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
TEST(Architecture, FilesThatRecipesNameExist) {
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
