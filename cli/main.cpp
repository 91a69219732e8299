// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command: a table. Each command is a file of its own in a folder beside this one.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "cli/console/exit_code.h"
#include "cli/console/interrupt.h"
#include "cli/console/manual.h"
#include "cli/console/supervisor.h"
#include "ods/base/large_blocks.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"

// One a file, in the folders beside this one.
int ods_blender(int argc, char** argv);
int ods_camera(int argc, char** argv);
int ods_comfort(int argc, char** argv);
int ods_compare(int argc, char** argv);
int ods_convert(int argc, char** argv);
int ods_denoise(int argc, char** argv);
int ods_encode(int argc, char** argv);
int ods_info(int argc, char** argv);
int ods_inject(int argc, char** argv);
int ods_jobs(int argc, char** argv);
int ods_lint(int argc, char** argv);
int ods_merge(int argc, char** argv);
int ods_over(int argc, char** argv);
int ods_probe(int argc, char** argv);
int ods_project(int argc, char** argv);
int ods_render(int argc, char** argv);
int ods_rig(int argc, char** argv);
int ods_scenes(int argc, char** argv);
int ods_sizes(int argc, char** argv);
int ods_stitch(int argc, char** argv);
int ods_submit(int argc, char** argv);
int ods_testcard(int argc, char** argv);
int ods_title(int argc, char** argv);
int ods_video(int argc, char** argv);
int ods_view(int argc, char** argv);

namespace {

struct Command {
  const char* name;
  const char* summary;
  int (*run)(int argc, char** argv);  // argv[0] is the command's name
};

constexpr Command kCommands[] = {
    {"render", "render a scene as a stereo 360 picture or frames", ods_render},
    {"convert", "change a picture's projection, layout, size or eyes", ods_convert},
    {"denoise", "remove the noise of a rendered picture, both eyes together", ods_denoise},
    {"merge", "merge the parts of a picture that several machines rendered", ods_merge},
    {"view", "show pictures and videos in the browser and in the headset", ods_view},
    {"video", "render a scene as a stereo 360 video", ods_video},
    {"encode", "encode frames as a stereo 360 video", ods_encode},
    {"submit", "send a command to a render farm, split into tasks", ods_submit},
    {"jobs", "show the progress of Slurm jobs", ods_jobs},
    {"title", "make a title with depth for stereo 360", ods_title},
    {"over", "composite a picture or video over another", ods_over},
    {"rig", "plan perspective cameras for other renderers", ods_rig},
    {"stitch", "combine the views of those cameras into a picture", ods_stitch},
    {"info", "show what is in a scene", ods_info},
    {"blender", "install the add-on for Blender", ods_blender},
    {"camera", "export a camera to another renderer", ods_camera},
    {"project", "project world points into each eye's picture", ods_project},
    {"compare", "measure the difference between two pictures", ods_compare},
    {"comfort", "find what strains a viewer's eyes", ods_comfort},
    {"lint", "find faults in a stereo 360 picture", ods_lint},
    {"probe", "show a file's 360 metadata and how players will interpret it", ods_probe},
    {"inject", "write 360 and stereo metadata into a video or picture", ods_inject},
    {"testcard", "make a test card for players and headsets", ods_testcard},
    {"scenes", "list the built-in scenes", ods_scenes},
    {"sizes", "list the named sizes", ods_sizes},
};

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
    if (const int code = command.run(2, arguments); code != kExitOk) return code;
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
  std::fprintf(stderr, "ods: error: there is no command '%s'%s (ods --help lists them)\n", name,
               ods::did_you_mean(name, ods::names_of(kCommands)).c_str());
  return kExitUsage;
}

}  // namespace

// Libraries' constructors run for a while: a Ctrl-C then is one like any other. What is left is the loader itself,
// which no code of ours precedes; there the signal ends the process, which has done nothing yet. Sanitizers are not
// ready then.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
[[gnu::section(".preinit_array"), gnu::used]] static void (*const before_constructors)() = [] { end_on_interrupts(); };
#endif

int main(int argc, char** argv) {
  if (argc > 0 && std::strcmp(argv[0], kSupervisor) == 0) return supervise(argc, argv);
  open_closed_streams();
  end_on_interrupts();
  ods::return_large_blocks();
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
  if (std::strcmp(name, "film") == 0) {
    std::fputs("ods: 'film' is now called 'video'; the old name ends with the next version\n", stderr);
    name = argv[1] = const_cast<char*>("video");
  }
  for (const Command& command : kCommands) {
    if (std::strcmp(name, command.name) == 0) return command.run(argc - 1, argv + 1);
  }
  return unknown_command(name);
}
