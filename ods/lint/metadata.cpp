// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares the metadata, the name and the sidecar of a file with each other and with the picture, whose layout is
// known.
#include "ods/picture/metadata/metadata.h"

#include <fmt/format.h>

#include <cmath>

#include "ods/camera/file_names.h"
#include "ods/image/format/xmp_file.h"
#include "ods/lint/checks.h"

namespace ods {

static void add(LintReport& report, double certainty, std::string evidence, std::string remedy) {
  report.findings.push_back({Fault::kMetadata, certainty, std::move(evidence), std::move(remedy)});
}

static std::string_view read_as(const LintReport& report) {
  return report.layout ? layout_name(*report.layout) : "one eye";
}

// GPano describes one sphere; viewers would wrap the whole file around it.
static void check_gpano(const Subject& subject, LintReport& report) {
  if (subject.is_video || report.eye_count < 2 || names_eye(subject.path) || subject.format.is_photo) return;
  if (read_xmp(files_of(subject.path).front()).find("GPano:") == std::string::npos) return;
  add(report, 1.0,
      "the stereo file contains GPano metadata, which cannot express stereo: viewers wrap both eyes around one sphere",
      "remove GPano from it (ods inject `remove` FILE)");
}

static void check_name(const Subject& subject, LintReport& report) {
  const NameWords named = read_name(subject.path);
  if (named.layout_token.empty() || names_eye(subject.path) || named.layout == report.layout) return;
  const Extent size = report.file;
  if (named.layout) {
    const std::optional<Extent> other = unpacked_size(*named.layout, size);
    if (other && report.layout && other->width == report.eye.width && other->height == report.eye.height &&
        !arrangement_of(*named.layout).right_first) {
      return;  // the same halves under a more general name
    }
  }
  add(report, 0.9,
      fmt::format("its name ends in {}, but it is {} as {}", named.layout_token, read_as(report),
                  subject.format.layout.reason),
      "rename it: players go by the name");
}

static void check_sidecar(const Subject& subject, LintReport& report) {
  if (!subject.sidecar) return;
  const Sidecar& said = *subject.sidecar;
  const std::string name = sidecar_path(subject.path);
  const char* remedy = "write the sidecar again, or remove it";
  const int count = static_cast<int>(said.eyes.size());
  if (count != report.eye_count) {
    return add(report, 0.9, fmt::format("'{}' declares {} eyes, but the file has {}", name, count, report.eye_count),
               remedy);
  }
  if (report.layout && said.layout != *report.layout) {
    add(report, 0.9, fmt::format("'{}' declares {}, but it is {}", name, layout_name(said.layout), read_as(report)),
        remedy);
  }
  const Extent stored = squeezed_eye(said.layout, said.eye, count);
  // A copy of another size is consistent; another aspect ratio is not.
  const double off = std::abs(static_cast<double>(stored.width) * report.eye.height /
                                  (static_cast<double>(stored.height) * report.eye.width) -
                              1.0);
  if (said.eye.width > 0 && said.eye.height > 0 && off > 0.02) {
    add(report, off / (off + 0.02),
        fmt::format("'{}' declares eyes of {}x{}, but they have {}x{}", name, stored.width, stored.height,
                    report.eye.width, report.eye.height),
        remedy);
  }
}

void check_metadata(const Subject& subject, LintReport& report) {
  judge(report, Check::kMetadata);
  check_gpano(subject, report);
  check_name(subject, report);
  check_sidecar(subject, report);
}

}  // namespace ods
