// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sources from which a file's layout, projection and camera are taken, in order of precedence. find_format() asks
// them in this order. docs/identify.md has this table for users; tests/cli/docs_test.cpp compares the two, and
// tests/cli/convert/convert_metadata_test.cpp tries each row.
#pragma once
#include <string_view>

#include "ods/base/names.h"

namespace ods {

enum class FormatSource { kOptions, kOwnMetadata, kSidecar, kOtherMetadata, kName, kPixels, kShape, kNothing };

struct FormatSourceRow {
  FormatSource member;
  std::string_view name;
  std::string_view text;  // for users
};

inline constexpr FormatSourceRow kFormatSourceTable[] = {
    {FormatSource::kOptions, "options", "of the command: layout, projection, circle, camera file"},
    {FormatSource::kOwnMetadata, "own metadata",
     "the second eye in a `.vr.jpg`, MPO or HEIC; `ods:` attributes of an EXR; the boxes and tags of a video"},
    {FormatSource::kSidecar, "sidecar", "`picture.camera.json` beside the file"},
    {FormatSource::kOtherMetadata, "other metadata",
     "two views or `envmap` in an EXR; the descriptor of a JPS; GPano; the place of a cropped TIFF"},
    {FormatSource::kName, "name", "`_TB`, `_LR`, `_SBS`, `_180`, `_360`, `_cube-3x2`, ...; `.jps`"},
    {FormatSource::kPixels, "pixels", "if they are sure"},
    {FormatSource::kShape, "shape", "width over height"},
    {FormatSource::kNothing, "nothing", "one eye; a picture is flat, a video is refused"},
};
static_assert(has_every_member(kFormatSourceTable));

}  // namespace ods
