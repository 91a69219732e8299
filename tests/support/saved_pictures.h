// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Saves pictures in tests that read them back.
#pragma once
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/image/format/file_format.h"
#include "ods/picture/save.h"

namespace ods {

inline SaveOptions options_for(Layout layout) {
  SaveOptions options;
  options.layout = layout;
  options.tone = ToneCurve::kLinear;
  return options;
}

// Maximum error of codecs, in linear light.
inline float tolerance(FileFormat format) {
  switch (format) {
    case FileFormat::kPng:
    case FileFormat::kTiff:
      return 0.004f;
    case FileFormat::kJpeg:
      return 0.02f;
    case FileFormat::kWebp:
      return 0.06f;
    case FileFormat::kHdr:
      return 0.004f;
    case FileFormat::kExr:
      return 0.0005f;
    case FileFormat::kHeif:
      break;
  }
  return 0.0f;
}

// A format from which both eyes can be read back, up to the codec's error.
struct SavedForm {
  Layout layout;
  FileFormat format;
  std::string name;  // "a.png", "%V.png"
  std::string text() const { return name + " " + std::string(layout_name(layout)); }
};

// Every layout in every format, except anaglyphs and checkerboards, which keep only part of each eye, and interleaved
// eyes in lossy formats, which mix them.
inline std::vector<SavedForm> every_saved_form() {
  std::vector<SavedForm> forms;
  for (const std::string extension : {"png", "jpg", "tif", "webp", "hdr", "exr"}) {
    const FileFormat format = *format_of_path("a." + extension);
    const bool lossy = format == FileFormat::kJpeg || format == FileFormat::kWebp;
    for (Layout layout : kLayouts) {
      if (layout == Layout::kMultiview && format != FileFormat::kExr) continue;
      if (is_anaglyph(layout) || layout == Layout::kCheckerboard) continue;
      if (arrangement_of(layout).is_interleaved() && lossy) continue;
      forms.push_back({layout, format, (layout == Layout::kSeparate ? "%V." : "a.") + extension});
    }
  }
  return forms;
}

}  // namespace ods
