// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/video/wordless.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ods/base/error.h"
#include "ods/video/container/complete_metadata.h"

using ods::Reading;

namespace {

bool video_can_express(const Reading& reading) {
  if (!reading.layout && reading.projection.kind == ods::kPerspective) return false;  // an ordinary video
  return (!reading.layout || arrangement_of(*reading.layout).is_halves()) && can_say_projection(reading.projection);
}

// Pixels do not show the field of view of a lens.
bool picture_can_express(const Reading& reading) {
  return !ods::has_fov(reading.projection.kind);
}

}  // namespace

std::optional<Wordless> judge_wordless(const ods::MediaFile& media) {
  if (!media.hint.lenses.empty())
    return Wordless{{}, fmt::format("it shows {}: ods convert unwraps them", fmt::join(media.notes, "; "))};
  if (!media.identity || media.identity->readings.empty()) return std::nullopt;
  if (!media.identity->is_sure()) return Wordless{{}, "it may be " + doubt_text(*media.identity)};
  const Reading& best = media.identity->best();
  const std::string looks =
      fmt::format("it looks like {}: {} ({:.2f})", reading_text(best), media.identity->reason, best.certainty);
  if (media.video ? video_can_express(best) : picture_can_express(best)) return Wordless{best, looks};
  return Wordless{{}, looks + "; if that is right, there is nothing to tag; otherwise give --layout and --projection"};
}

std::optional<Wordless> wordless_to_tag(const ods::MediaFile& media) {
  std::optional<Wordless> found = judge_wordless(media);
  if (!found || found->reading) return found;
  throw ods::Error(
      ods::ErrorKind::kInput,
      fmt::format("cannot tag '{}': its metadata and name do not specify its format, and {}", media.path, found->text));
}
