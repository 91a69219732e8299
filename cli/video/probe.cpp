// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods probe: shows a video's or a picture's metadata, and how players will interpret it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/options.h"
#include "cli/options/projection_options.h"
#include "cli/video/probe_report.h"
#include "cli/video/wordless.h"
#include "ods/base/error.h"
#include "ods/camera/file_names.h"
#include "ods/files/memory_file.h"
#include "ods/image/format/xmp_file.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/vr_photo.h"

namespace {

constexpr const char* kProbeExamples =
    "  ods probe video_360_TB.mp4\n"
    "  ods probe picture.jpg\n"
    "  ods probe video.mkv --json";

constexpr const char* kProbeSummary =
    "Shows the metadata of a video (mp4, mov, mkv, webm) or picture: tracks, Spherical Video V1 and V2, GPano, "
    "camera;\n"
    "how each kind of player will interpret it, and why; and what is wrong with it.";

// A photo with a damaged right eye is still a picture of the left one.
void probe_right_eye(PictureReport& report, const std::string& path, std::vector<std::string>& warnings) {
  if (report.info.is_pair) {
    report.right_eye = fmt::format("{}x{}", report.info.width, report.info.height);
    return;
  }
  try {
    const ods::MemoryFile file(ods::read_right_eye(path, warnings));
    const ods::FileInfo eye = ods::read_info(file.path());
    report.right_eye = fmt::format("{}x{}", eye.width, eye.height);
    if (eye.width == report.info.width && eye.height == report.info.height) return;
    warnings.push_back(fmt::format("its right eye has {} pixels, the left one {}x{}", report.right_eye,
                                   report.info.width, report.info.height));
  } catch (const ods::Error& error) {
    if (error.kind() != ods::ErrorKind::kInput) throw;
    report.right_eye = "damaged";
    warnings.push_back(error.what());
  }
}

// Describes what ods inject would do.
void add_wordless(const std::optional<Wordless>& seen, std::vector<std::string>& warnings) {
  if (!seen) return;
  warnings.push_back(fmt::format("its metadata and name do not specify its format, and {}{}", seen->text,
                                 seen->reading ? " (ods inject tags it so)" : ""));
}

// Describes what ods makes of two tracks that may belong together. If it cannot decide, that is a warning.
std::string joined_tracks(const std::string& path, std::vector<std::string>& warnings) {
  try {
    const ods::MediaFile media = ods::open_media(path);
    return are_tracks(media.views) ? fmt::format("{}", fmt::join(media.notes, "; ")) : "";
  } catch (const ods::Error& error) {
    if (error.kind() != ods::ErrorKind::kInput) throw;
    warnings.push_back(error.what());
    return "";
  }
}

ProbeReport probe(const std::string& path) {
  ProbeReport report;
  report.path = path;
  if (!ods::names_files(path) && ods::is_video(path)) {
    report.video = ods::read_video_file(path);
    std::vector<std::string> doubts;
    if (report.video->tracks.size() > 1) report.joined = joined_tracks(path, doubts);
    for (const ods::VideoTrack& track : report.video->tracks) {
      report.views.push_back(video_views(*report.video, track, path));
      report.warnings.push_back(video_warnings(*report.video, track, path));
      const ods::MediaFile media = ods::open_media(path, {.track = static_cast<int>(track.id)});
      if (report.joined.empty()) add_wordless(judge_wordless(media), report.warnings.back());
      const std::string fault = ods::reading_fault(path, track.id);
      if (!fault.empty()) report.warnings.back().push_back(fault);
      const bool is_seen = media.identity && !media.identity->readings.empty();
      report.seen.push_back(is_seen ? media.identity : std::nullopt);
    }
    if (!doubts.empty()) report.warnings.back().push_back(doubts[0]);
    return report;
  }
  const ods::MediaFile media = ods::open_media(path, {.color_only = true});
  const ods::FileInfo& info = media.reader->info();
  const ods::StereoFormat& format = media.format;
  const std::string xmp = info.is_float ? "" : ods::read_xmp(ods::files_of(path).front());
  report.picture = PictureReport{info, format, ods::gpano_camera(xmp), ""};
  const bool has_gpano = report.picture->gpano.has_value();
  report.views.push_back(picture_views(info, format, has_gpano, path));
  report.seen.push_back(media.identity);
  report.warnings.push_back(picture_warnings(info, format, has_gpano, path));
  if (!info.color_fault.empty()) report.warnings[0].push_back(info.color_fault);
  add_wordless(judge_wordless(media), report.warnings[0]);
  if (format.is_photo) probe_right_eye(*report.picture, path, report.warnings[0]);
  return report;
}

struct ProbeJob {
  std::vector<std::string> files;
  bool json = false;
};

ProbeJob parse_probe(Options& options) {
  ProbeJob job;
  options.describe(kProbeSummary, kProbeExamples);
  add_input_argument(options, ValueKind::input_file("FILE"), job.files, "a video or a picture");
  options.group("Console");
  options.flag("--json", job.json, "print JSON");
  add_console_options(options);
  options.parse();
  return job;
}

void run_probe(const ProbeJob& job) {
  ProbeReport report = probe(joined_input(job.files, {}));
  for (std::vector<std::string>& warnings : report.warnings) {
    for (std::string& warning : warnings) warning = with_options(warning);
  }
  job.json ? print_json(report) : print_text(report);
}

}  // namespace

extern const Command kProbe =
    make_command<parse_probe, run_probe>("probe", "show a file's 360 metadata and how players will interpret it");
