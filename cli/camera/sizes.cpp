// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods sizes: the sizes that have names, for people or as JSON.
#include "ods/camera/sizes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/print.h"
#include "cli/options/picture_options.h"
#include "ods/camera/codec_level.h"

using ods::NamedSize;

namespace {

constexpr const char* kSizesExamples =
    "  ods sizes\n"
    "  ods sizes tb-high-6480                     everything about one\n"
    "  ods render room -o room.png --size tb-minimum-3600";

constexpr int kStillFps = 30;  // the rate for the levels of sizes whose sources do not give one

std::string_view layout_token(const NamedSize& size) {
  return size.layout ? ods::layout_name(*size.layout) : "one eye";
}

std::string pixels(ods::Extent extent) {
  return fmt::format("{}x{}", extent.width, extent.height);
}

std::string level(const NamedSize& size, ods::Codec codec) {
  const std::string_view name = ods::smallest_level(codec, ods::file_size(size), size.fps ? size.fps : kStillFps);
  return std::string(name.empty() ? "none" : name);
}

// The host of an address.
std::string_view short_source(const NamedSize& size) {
  return size.source.substr(0, size.source.find_first_of("/ :"));
}

void print_table(std::span<const NamedSize> sizes) {
  constexpr const char* kRow = "{:<19} {:<11} {:<12} {:<11} {:>3} {:>5} {:>4} {:>4} {:>4} {:<4} {}\n";
  put_out(fmt::format(kRow, "name", "one eye", "layout", "file", "fps", "H.264", "HEVC", "AV1", "VP9", "AA", "source"));
  for (const NamedSize& size : sizes) {
    const bool threshold = size.antialias.starts_with("on, threshold ");
    put_out(fmt::format(kRow, size.name, pixels(size.eye), layout_token(size), pixels(file_size(size)),
                        size.fps ? fmt::format("{}", size.fps) : "", level(size, ods::Codec::kH264),
                        level(size, ods::Codec::kHevc), level(size, ods::Codec::kAv1), level(size, ods::Codec::kVp9),
                        threshold ? size.antialias.substr(14) : size.antialias, short_source(size)));
  }
  put_out(fmt::format(
      "\nH.264, HEVC, AV1, VP9: the smallest level that holds the file as a video, at {} pictures a second where fps\n"
      "is empty; without one, players may refuse it. AA: the source's antialiasing, off or POV-Ray's threshold.\n",
      kStillFps));
}

void print_one(const NamedSize& size) {
  auto row = [](std::string_view name, std::string_view value) { put_out(fmt::format("{:<14} {}\n", name, value)); };
  row("name", size.name);
  row("called", size.title);
  row("one eye", pixels(size.eye));
  row("layout", layout_token(size));
  row("file", pixels(file_size(size)));
  if (size.fps) row("fps", fmt::format("{}", size.fps));
  for (ods::Codec codec : ods::kCodecs) {
    row(ods::codec_name(codec), fmt::format("level {} at {} fps", level(size, codec), size.fps ? size.fps : kStillFps));
  }
  if (!size.antialias.empty()) row("antialiasing", size.antialias);
  row("source", size.source);
}

nlohmann::ordered_json to_json(const NamedSize& size) {
  const ods::Extent file = file_size(size);
  nlohmann::ordered_json json = {{"name", size.name},
                                 {"title", size.title},
                                 {"eye", {size.eye.width, size.eye.height}},
                                 {"layout", layout_token(size)},
                                 {"file", {file.width, file.height}},
                                 {"fps", nullptr},
                                 {"levels_at_fps", size.fps ? size.fps : kStillFps},
                                 {"levels", nlohmann::ordered_json::object()},
                                 {"antialias", nullptr},
                                 {"source", size.source}};
  if (size.fps) json["fps"] = size.fps;
  if (!size.antialias.empty()) json["antialias"] = size.antialias;
  for (ods::Codec codec : ods::kCodecs) json["levels"][std::string(ods::codec_name(codec))] = level(size, codec);
  return json;
}

void print_json(std::span<const NamedSize> sizes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const NamedSize& size : sizes) json.push_back(to_json(size));
  put_json(json);
}

struct SizesJob {
  std::string name;  // of one size; empty: all
  bool json = false;
};

SizesJob parse_sizes(Options& options) {
  SizesJob job;
  options.describe("Lists the named sizes and the video levels that they fit in.", kSizesExamples);
  options.optional_argument("NAME", job.name, "show one size in detail");
  options.group("Console");
  options.flag("--json", job.json, "print JSON");
  add_console_options(options);
  options.parse();
  return job;
}

void list_sizes(const SizesJob& job) {
  const bool one = !job.name.empty();
  const std::span<const NamedSize> chosen = one ? std::span(&size_by_name(job.name), 1) : ods::named_sizes();
  if (job.json) return print_json(chosen);
  one ? print_one(chosen.front()) : print_table(chosen);
}

}  // namespace

extern const Command kSizes = make_command<parse_sizes, list_sizes>("sizes", "list the named sizes");
