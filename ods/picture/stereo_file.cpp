// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/stereo_file.h"

#include "ods/base/text.h"

namespace ods {

static constexpr NameRow<StereoFile> kStereoFiles[] = {
    {StereoFile::kVrPhoto, ".vr.jpg"},
    {StereoFile::kMpo, ".mpo"},
    {StereoFile::kSpatial, ".heic"},
    {StereoFile::kJps, ".jps"},
};
static_assert(has_every_member(kStereoFiles));

std::optional<StereoFile> stereo_file(const std::string& path) {
  const std::string name = small_letters(path);
  for (const NameRow<StereoFile>& row : kStereoFiles) {
    if (name.ends_with(row.name)) return row.member;
  }
  return std::nullopt;
}

std::string_view stereo_file_extension(StereoFile kind) {
  return name_in(kStereoFiles, kind);
}

}  // namespace ods
