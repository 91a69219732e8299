// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every command that README, the pages of docs/ and help show is run, made small, on substitutes for the files that it
// names. A command that cannot be run must at least be parsed: its exit code is not the code of a wrong command line.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/console/command.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/render/unfinished.h"
#include "tests/support/compressed_gltf.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/made_frames.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace ods::docs_test {

namespace fs = std::filesystem;

// Commands that start so need what no test has.
const std::map<std::string, std::string> kCannotRun = {
    {"ods stitch rig.json '%V.#.png'", "sheets of Unreal's plug-in"},
    {"ods blender --blender", "another Blender than that of PATH"},
    {"ods render house.blend --renderer", "a Blender that renders"},
    {"ods video shot.blend --renderer", "a Blender that renders"},
    {"ods submit --to slurm -- video shot.blend --renderer", "a Blender that renders"},
};

// Options of other programs that the pages call, and options that every command has.
const std::set<std::string> kOthersOptions = {"--help", "--version"};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A line's arguments, without their quotes. A command ends before >, <, | and #.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  const std::regex word("'([^']*)'|\"([^\"]*)\"|([^ ]+)");
  for (std::sregex_iterator each(line.begin(), line.end(), word), end; each != end; ++each) {
    words.push_back((*each)[1].str() + (*each)[2].str() + (*each)[3].str());
  }
  return words;
}

struct Command {
  std::string line;       // "ods render room -o room.png"
  std::string redirects;  // "> camera.inc"
};

// Two spaces in help, and # anywhere, start a remark to the reader; what follows || runs if ods fails.
Command parse_line(const std::string& line) {
  const std::regex command(
      "(ods (?:'[^']*'|\"[^\"]*\"|  ?-|  ?\\\\|[^'\"<>|# ]| (?![ #<>|])|#(?!\\s))*)\\s*([<>] *\\S+)?.*");
  std::smatch match;
  EXPECT_TRUE(std::regex_match(line, match, command)) << line;
  return {match[1], match[2]};
}

// The lines in a page's blocks of code that call ods; a backslash at the end continues a line.
std::vector<Command> commands_of_page(const std::string& text) {
  std::vector<Command> commands;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const size_t start = line.find_first_not_of(' ');
    if (start == std::string::npos || line.compare(start, 4, "ods ") != 0) continue;
    if (start < 2 && start != 0) continue;
    std::string more;
    while (line.ends_with("\\") && std::getline(lines, more)) {
      line.pop_back();
      line += more.substr(more.find_first_not_of(' '));
    }
    commands.push_back(parse_line(line.substr(start)));
  }
  return commands;
}

// The texts between backquotes.
std::vector<std::string> code_spans(const std::string& text) {
  std::vector<std::string> spans;
  const std::regex span("`([^`\n]+)`");
  for (std::sregex_iterator each(text.begin(), text.end(), span), end; each != end; ++each) {
    spans.push_back((*each)[1].str());
  }
  return spans;
}

std::vector<std::string> page_names() {
  const fs::path root = source_folder();
  std::vector<std::string> names = {"README.md"};
  for (const fs::directory_entry& entry : fs::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") names.push_back("docs/" + entry.path().filename().native());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// A page's, and those within its text where that has whole ones.
std::vector<Command> all_commands_of(const std::string& page) {
  const std::string text = read_file(fs::path(source_folder()) / page);
  std::vector<Command> commands = commands_of_page(text);
  if (page != "docs/tasks.md" && page != "README.md") return commands;
  for (const std::string& span : code_spans(text)) {
    if (span.starts_with("ods ") && words_of(span).size() > 2) commands.push_back(parse_line(span));
  }
  return commands;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const ::Command& command : commands()) names.emplace_back(command.name);
  return names;
}

std::set<std::string> options_in(const std::string& text) {
  const std::regex option("(^|[ ,])(--[a-z][a-z-]*)");
  std::set<std::string> names = {};
  for (std::sregex_iterator each(text.begin(), text.end(), option), end; each != end; ++each) names.insert((*each)[2]);
  return names;
}

class Pages : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder.path("bin"));
    provide_cluster();
    provide_blender();
    fs::create_directory(folder.path("home"));
    setenv("ASAN_OPTIONS", "detect_leaks=0", 0);  // as in cli_runner.h
    setenv("XDG_STATE_HOME", folder.path("home").c_str(), 1);
    setenv("XDG_CACHE_HOME", folder.path("home").c_str(), 1);  // a program that a test runs has no business elsewhere
  }

  // Runs a shell command in the folder; `ods` is ours.
  int shell(const std::string& words) {
    const std::string script = "cd '" + folder.path("") + "' && { " + words + "\n} 2>log.txt >>out.txt";
    const int status = std::system(("sh -c " + quoted("ods() { '" + ods_command() + "' \"$@\"; }\n" + script)).c_str());
    return WEXITSTATUS(status);
  }

  static std::string quoted(const std::string& text) {
    return "'" + std::regex_replace(text, std::regex("'"), "'\\''") + "'";
  }

  void program(const std::string& name, const std::string& script) const {
    folder.write("bin/" + name, "#!/bin/sh\n" + script + "\n");
    fs::permissions(folder.path("bin/" + name), fs::perms::owner_all);
  }

  // A Blender that converts every scene to the same one, and takes every add-on.
  void provide_blender() const {
    folder.write("bin/scene.glb", scene());
    program(
        "blender",
        "while [ \"$1\" != -- ]; do shift; done\nif [ -d \"$3\" ]; then\ncp " + folder.path("bin/scene.glb") +
            " \"$3\"\necho '{\"omnistereo_bridge\": 1, \"camera\": {\"omnistereo_camera\": 1}}' >\"$3/bridge.json\"\n"
            "fi\necho 'ods-bridge done 1' >&2");
  }

  // A cluster that reports all jobs as done at once.
  void provide_cluster() {
    const std::string queue = folder.path("bin/queue");
    folder.write("bin/queue", "");
    program("squeue", "[ $1 != --json ] && cat " + queue);
    program("scontrol", "echo MaxArraySize = 1001");
    program("sbatch", "id=$(($(wc -l <" + queue + ") + 1))\n" +
                          "for word; do case $word in --comment=*) comment=${word#--comment=} ;; esac; done\n" +
                          "tasks=$(sed -n 's/^#SBATCH --array=1-//p' \"$word\")\n" +
                          "for task in $(seq ${tasks:-1}); do echo \"$id|$task|COMPLETED|0:01||$comment\" >>" + queue +
                          "; done\necho $id");
    static const std::string path = std::getenv("PATH");
    setenv("PATH", (folder.path("bin") + ":" + path).c_str(), 1);
  }

  // The command's name; for ods submit the name of the command that it sends.
  static std::string command_of(const std::string& line) {
    const std::vector<std::string> words = words_of(line);
    const auto dashes = std::find(words.begin(), words.end(), "--");
    return words.at(1) == "submit" && dashes + 1 < words.end() ? *(dashes + 1) : words.at(1);
  }

  // Options that make the command small: the last of an option counts.
  static std::string made_small(const std::string& line) {
    const std::string command = command_of(line);
    const bool has_width = has(line, "--width") || has(line, "--size"), of_rig = has(line, "--rig ");
    const bool renders = command == "render" || command == "video";
    std::string more = !renders                    ? ""
                       : has(line, "--statistics") ? " --samples 2"
                       : has(line, "--part")       ? " --samples 64"
                                                   : " --samples 1";
    if (renders) more += of_rig ? " --bounces 1" : " --bounces 1 --exposure 0";  // it need not be measured
    const bool of_picture = has(line, ".exr ") || has(line, "--depth ");
    if (command == "layers") more = of_picture ? " --width 256" : " --samples 1 --bounces 1 --exposure 0 --width 256";
    if (command == "rig") {
      more += has(line, "--slits") ? " --width 96 --slits 12" : " --width 64";
      if (has(line, "--max-error")) more += " --max-error 4";
    } else if (has(line, "--sheet")) {
      more += " --sheet 12x3";
    } else if (command == "testcard") {
      more += " --width 512";
    } else if (renders || command == "title" || has_width) {
      more += of_rig ? "" : " --width 96";
    }
    if (has(line, "--frames") || command == "video") more += " --frames 1-4";
    if (has(line, "--trim")) more += " --trim 0-1";
    if (has(line, "--duration") || has(line, "--video")) more += " --duration 0.2";
    return of_rig && command == "video" ? " --frames 1-4" : more;
  }

  // Makes what a command reads where it is not there.
  void provide(const std::string& line) {
    const std::vector<std::string> words = words_of(line);
    std::string rig;
    const auto stitch = std::find(words.begin(), words.end(), "stitch");
    if (stitch != words.end()) rig = *std::next(stitch);
    if (words.at(1) == "jobs" && words.size() > 2) provide_job(words.at(2));
    const auto option = std::find(words.begin(), words.end(), "--rig");
    if (option != words.end()) rig = *std::next(option);
    if (!rig.empty() && !fs::exists(folder.path(rig))) make("ods rig --width 64 --nearest 0.8 -o " + rig);
    for (size_t i = 2; i < words.size(); i++) {
      static const std::set<std::string> outputs = {"-o",    "--output", "--report", "--diff",
                                                    "--for", "--font",   "--export"};
      if (outputs.contains(words[i - 1]) || words[i] == rig) continue;
      if (!rig.empty() && words[i].find_first_of("#%") != std::string::npos) {
        provide_views(words[i], rig);
      } else {
        provide_file(words[i]);
      }
    }
  }

  void provide_job(const std::string& name) {
    const fs::path folder_of_job = fs::path(name).parent_path();
    make("ods submit -q --to slurm --chunk 2 -- video toys --width 96 --samples 1 --frames 1-4 --restart -o " +
         quoted((folder_of_job / fs::path(name).stem()).native() + ".mp4"));
  }

  // Views of an earlier rig may lie there.
  void provide_views(const std::string& pattern, const std::string& rig) {
    const std::string parent = fs::path(pattern).parent_path().native(), file = fs::path(pattern).filename().native();
    for (const char* frame : {"0001", "0002", "0003", "0004"}) {
      const std::string views = std::regex_replace(parent, std::regex("####"), frame);
      fs::remove_all(folder.path(views));
      make("ods render axis --samples 1 --bounces 1 --rig " + rig + " -o " + quoted(views + "/" + file));
      if (views == parent) return;
    }
  }

  void provide_file(const std::string& name) {
    if (name.ends_with("/")) return provide_file(name + "picture_360_TB.png");
    const std::string kind = fs::path(name).extension().native();
    if (kind.empty() || name.starts_with("-") || fs::exists(folder.path(name)) || !made_.insert(name).second) return;
    fs::create_directories(fs::path(folder.path(name)).parent_path());
    if (kind == ".npy" || name == "depth.png") return folder.write(name, depth());
    if (name.ends_with(".layers.glb")) return make("ods layers spheres --samples 1 --width 256 -o " + name);
    if (kind == ".glb") return folder.write(name, scene());
    if (kind == ".blend") return folder.write(name, "BLENDER-v304");
    if (kind == ".zip") return provide_archive(name);
    if (kind == ".wav") return folder.write(name, ods::made::wav(4, 0.2));
    if (kind == ".txt") return folder.write(name, "0,1,-2\n");
    if (kind == ".keys") return folder.write(name, "0 1.5  # degrees\n0:01 -2\n");
    if (kind == ".unfinished") return provide_unfinished(name);
    if (name == "tour.json") {
      provide_file("hall_360_TB.jpg");
      return folder.write(name, R"({"panoramas": ["hall_360_TB.jpg"]})");
    }
    if (kind == ".json") return make("ods camera --for json --width 4096 -o " + name);
    if (kind == ".mp4" || kind == ".mov" || kind == ".mkv" || kind == ".webm") {
      provide_file("sound.wav");
      const std::string eyes = has(name, "panorama") ? " --eyes mono" : "";
      return make("ods video axis --width 96 --samples 1 --duration 0.1 --audio sound.wav -o " + name + eyes);
    }
    static const std::set<std::string> pictures = {".png", ".jpg", ".exr", ".tif", ".hdr", ".webp"};
    if (pictures.contains(kind)) provide_picture(name);
  }

  // The depth of a level floor under the sky: NumPy's floats, in proportion to 1 / metres.
  static std::string depth() {
    std::string words = "{'descr': '<f4', 'fortran_order': False, 'shape': (48, 96), }";
    words.resize(118, ' ');
    std::string bytes = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + words;
    for (int i = 0; i < 96 * 48; i++) {
      const float nearness = std::max(0.0f, -std::cos(3.14159265f * (static_cast<float>(i / 96) + 0.5f) / 48.0f));
      bytes.append(reinterpret_cast<const char*>(&nearness), sizeof nearness);
    }
    return bytes;
  }

  void provide_archive(const std::string& name) {
    const std::string glb = scene();
    const ods::Binary zip = ods::make_zip({{"model/scene.glb", {glb.begin(), glb.end()}}});
    folder.write(name, {zip.begin(), zip.end()});
  }

  // The file that an interrupted rendering leaves.
  void provide_unfinished(const std::string& name) {
    ods::RenderOptions options;
    options.width = 96, options.height = 48, options.noise = 0.1f;
    const std::string camera = ods::write_sidecar({ods::StereoCamera(), {options.width, options.height}});
    ods::write_unfinished(folder.path(name), {{}, camera, 0.0f, ods::ToneCurve::kNeutral, options},
                          ods::no_samples(options));
  }

  void provide_parts(const std::string& name) {
    for (const std::string part : {"1", "2"}) {
      const std::string file = std::regex_replace(name, std::regex("#|1|2"), part);
      make("ods render axis --samples 4 --width 96 --part " + part + "/2 -o " + file);
    }
  }

  void provide_picture(const std::string& name) {
    if (has(name, "part_")) return provide_parts(name);
    const bool is_title = has(name, "title.") || has(name, "robot");  // has alpha
    std::string words = is_title ? "ods title T --text-height 1" : "ods render axis --samples 1";
    if (has(name, "_LR")) words += " --projection vr180";
    if (has(name, "noisy")) words += " --statistics --samples 2";
    if (has(name, "other")) return provide_halves(name);
    static const std::set<std::string> kMono = {"panorama", "left.", "sky", "depth."};
    if (std::any_of(kMono.begin(), kMono.end(), [&](const auto& each) { return has(name, each); })) {
      words += " --eyes mono";
    }
    if (has(name, "#") || has(name, "%0")) words += " --frames 1-4";
    const bool of_lenses = has(name, "camera.");  // large enough to be recognised
    if (of_lenses) words += " --projection fisheye --layout side-by-side";
    make(words + (of_lenses ? " --width 256" : " --width 96") + " -o " + quoted(name));
  }

  // A picture as another renderer writes it: two pictures of half of the samples each, and a variance of one channel.
  void provide_halves(const std::string& name) {
    ods::PictureRows rows;
    rows.eye = {32, 16};
    rows.eyes = {ods::kLeft, ods::kRight};
    for (const char* layer : {"", "halfA.", "halfB."}) {
      const std::string of = layer;
      rows.layers.push_back({{of + "R", of + "G", of + "B"}, ods::LayerRule::kMean, ods::SampleType::kFloat});
    }
    rows.layers.push_back({{"noise"}, ods::LayerRule::kNearest, ods::SampleType::kFloat});
    rows.fill = [](int, int y, std::span<float> row) {
      for (size_t i = 0; i < row.size(); i++) row[i] = 0.1f * static_cast<float>((i + static_cast<size_t>(y)) % 7);
    };
    ods::save_picture(rows, nullptr, {}, folder.path(name));
  }

  void make(const std::string& words) { EXPECT_EQ(shell(words), 0) << words << "\n" << log(); }

  std::string log() const { return folder.read("log.txt"); }

  // A scene of two objects, one of which moves for a fifth of a second.
  static std::string scene() {
    ods::GltfBuilder scene = ods::make_triangle();
    const int times = scene.add<float>({0.0f, 0.2f}, ods::kFloat, "SCALAR");
    const int places = scene.add<float>({0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f}, ods::kFloat, "VEC3");
    scene.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    scene.json["nodes"][0]["name"] = "Ground";
    scene.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}};
    const ods::Binary glb = scene.glb();
    return {glb.begin(), glb.end()};
  }

  void try_command(const Command& command) {
    SCOPED_TRACE(command.line);
    const auto reason = std::find_if(kCannotRun.begin(), kCannotRun.end(),
                                     [&](const auto& each) { return command.line.starts_with(each.first); });
    const bool can_run = reason == kCannotRun.end();
    if (can_run) {
      provide(command.line);
      if (command.redirects.starts_with("<")) provide_file(words_of(command.redirects).at(1));
    }
    if (words_of(command.line).at(1) == "view" && !has(command.line, "--export")) return try_server(command.line);
    const int code = shell(command.line + made_small(command.line) + " " + command.redirects);
    const std::string name = words_of(command.line).at(1);
    const bool judges = name == "lint" || name == "compare" || name == "comfort";  // and ours are odd
    const bool is_tiny = name == "comfort" && code == 3 && has(log(), "matched");  // ours have few pixels
    EXPECT_TRUE(!can_run || code == 0 || (judges && code == 5) || is_tiny) << "exit code " << code << ": " << log();
    EXPECT_NE(code, 2) << log();
  }

  // Serves until it is ended.
  void try_server(const std::string& line) {
    const std::string network = has(line, "--lan") ? " || test $code = 3" : "";  // perhaps there is none
    const std::string words = ods_command() + line.substr(3) + " --no-browser";
    EXPECT_EQ(shell("rm -f address; timeout -s TERM 60 " + words +
                    " >address & while kill -0 $! && ! test -s address; do sleep 0.1; done; "
                    "kill $!; wait $!; code=$?; test $code = 143" +
                    network),
              0)
        << log();
    EXPECT_TRUE(!network.empty() || has(folder.read("address"), "http://127.0.0.1:")) << log();
  }

  ods::TemporaryFolder folder;

 private:
  std::set<std::string> made_;
};

// Which tests/install_test.cmake compiles.
TEST_F(Pages, TheReadmeShowsAnExample) {
  const std::string readme = read_file(fs::path(source_folder()) / "README.md");
  const std::string example = read_file(fs::path(source_folder()) / "examples/minimal.cpp");
  const size_t begin = readme.find("```cpp\n") + 7;
  const std::string code = readme.substr(begin, readme.find("```", begin) - begin);
  EXPECT_GT(code.size(), 100u);
  EXPECT_NE(example.find("{\n  " + std::regex_replace(code, std::regex("\n(?!$)"), "\n  ") + "}"), std::string::npos);
}

// Commands that an earlier page shows are tried with that page.
class Docs : public Pages, public ::testing::WithParamInterface<std::string> {};

TEST_P(Docs, CommandsOfThisPageWork) {
  std::set<std::string> tried;
  for (const std::string& page : page_names()) {
    for (const Command& command : all_commands_of(page)) {
      const bool is_first = tried.insert(command.line + command.redirects).second;
      if (page == GetParam() && is_first) try_command(command);
    }
    if (page == GetParam()) return;
  }
}

// "--turntable", "ods render --rig", ..., wherever text names them.
TEST_F(Pages, OptionsThatTheyNameExist) {
  std::map<std::string, std::set<std::string>> options;  // of a command; of all under ""
  for (const std::string& command : command_names()) {
    ASSERT_EQ(shell("ods " + command + " --help >help.txt"), 0);
    options[command] = options_in(folder.read("help.txt"));
    options[""].insert(options[command].begin(), options[command].end());
  }
  std::string text;
  for (const std::string& page : page_names()) text += read_file(fs::path(source_folder()) / page);
  for (const std::string& span : code_spans(text)) {
    const bool whole = span.starts_with("ods ");
    if (!whole && !span.starts_with("--")) continue;
    const std::string name_of_command = whole ? words_of(span).at(1) : "";
    const std::string command = name_of_command == "submit" ? "" : name_of_command;  // it has another behind it
    for (const std::string& name : options_in(span)) {
      EXPECT_TRUE(options[command].contains(name) || kOthersOptions.contains(name)) << "`" << span << "`: " << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, Docs, ::testing::ValuesIn(page_names()), [](const auto& page) {
  return std::regex_replace(page.param, std::regex("[^A-Za-z0-9]"), "_");
});

class Help : public Docs {};

TEST_P(Help, ExamplesWork) {
  ASSERT_EQ(shell("ods " + GetParam() + " --help"), 0);
  const std::string help = folder.read("out.txt");
  const size_t begin = help.find("Examples:"), end = help.find("\n\n", begin);
  const std::vector<Command> commands = commands_of_page(help.substr(begin, end - begin));
  EXPECT_FALSE(commands.empty());
  for (const Command& command : commands) try_command(command);
}

INSTANTIATE_TEST_SUITE_P(Commands, Help, ::testing::ValuesIn(command_names()),
                         [](const auto& name) { return name.param; });

}  // namespace ods::docs_test
