// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command: a table. Each command is one file beside this one.
//
// The commands live in a shared object that is opened when one is run: the image library beneath them takes a quarter
// of a second to load (hundreds of libraries on Debian), and some 100 MB of memory. The list of commands, --version and
// a misspelt command do not wait for that; `ods COMMAND --help` does. A command that needs neither that library nor
// FFmpeg has a shared object of its own.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "cli/console/exit_code.h"
#include "cli/console/manual.h"
#include "ods/base/suggest.h"

namespace {

struct Command {
  const char* name;
  const char* summary;
  const char* function;  // int function(int argc, char** argv), argv[0] being the command's name
  const char* library = "ods_commands.so";
};

constexpr Command kCommands[] = {
    {"render", "render a scene as a stereo 360 picture or frames", "ods_render"},
    {"convert", "change a picture's projection, layout, size or eyes", "ods_convert"},
    {"video", "render a scene as a stereo 360 video", "ods_video"},
    {"encode", "encode frames as a stereo 360 video", "ods_encode"},
    {"title", "make a title with depth for stereo 360", "ods_title"},
    {"over", "composite a picture or video over another", "ods_over"},
    {"rig", "plan perspective cameras for other renderers", "ods_rig"},
    {"stitch", "combine the views of those cameras into a picture", "ods_stitch"},
    {"info", "show what is in a scene", "ods_info"},
    {"camera", "export a camera to another renderer", "ods_camera"},
    {"project", "project world points into each eye's picture", "ods_project"},
    {"compare", "measure the difference between two pictures", "ods_compare"},
    {"lint", "find faults in a stereo 360 picture", "ods_lint"},
    {"probe", "show a file's 360 metadata and how players will interpret it", "ods_probe"},
    {"inject", "write 360 and stereo metadata into a video or picture", "ods_inject", "ods_inject.so"},
    {"testcard", "make a test card for players and headsets", "ods_testcard"},
    {"scenes", "list the built-in scenes", "ods_scenes"},
    {"sizes", "list the named sizes", "ods_sizes"},
};

int run(const Command& command, int argc, char** argv) {
  void* library = dlopen(command.library, RTLD_NOW | RTLD_LOCAL);  // found beside ods, or where install put it
  void* symbol = library ? dlsym(library, command.function) : nullptr;
  if (!symbol) {
    std::fprintf(stderr, "ods: error: the commands cannot be loaded: %s\n", dlerror());
    return kExitFailure;
  }
  return reinterpret_cast<int (*)(int, char**)>(symbol)(argc, argv);
}

// Help, a man page or a completion script, of which every command writes its own part.
std::string overview(ManualFormat format) {
  std::vector<CommandSummary> commands;
  for (const Command& command : kCommands) commands.push_back({command.name, command.summary});
  return write_overview(commands, format);
}

int print_overview(ManualFormat format, char* help_option) {
  std::fputs(overview(format).c_str(), stdout);
  if (format == ManualFormat::kHelp || format == ManualFormat::kMan) return kExitOk;
  for (const Command& command : kCommands) {
    std::string name = command.name;
    char* arguments[] = {name.data(), help_option, nullptr};
    if (const int code = run(command, 2, arguments); code != kExitOk) return code;
  }
  std::fputs(end_of_overview(format).c_str(), stdout);
  return kExitOk;
}

// The first picture would get the number of a stream that is closed, and with it what is printed there.
void open_closed_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDWR) != stream) std::abort();
  }
}

int unknown_command(const char* name) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.push_back(command.name);
  std::fprintf(stderr, "ods: error: there is no command '%s'%s (ods --help lists them)\n", name,
               ods::did_you_mean(name, names).c_str());
  return kExitUsage;
}

}  // namespace

int main(int argc, char** argv) {
  open_closed_streams();
  if (argc < 2) {
    std::fputs(overview(ManualFormat::kHelp).c_str(), stderr);
    return kExitUsage;
  }
  const char* name = argv[1];
  const auto format = manual_format(std::strcmp(name, "help") == 0 ? "--help" : name);
  if (format) return print_overview(*format, argv[1]);
  if (std::strcmp(name, "--version") == 0) {
    std::puts("ods " ODS_VERSION "\n" ODS_LIBRARIES);
    return kExitOk;
  }
  for (const Command& command : kCommands) {
    if (std::strcmp(name, command.name) == 0) return run(command, argc - 1, argv + 1);
  }
  return unknown_command(name);
}
