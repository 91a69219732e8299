// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Saving pictures in tests that read them back.
#pragma once
#include "ods/image/format/file_format.h"
#include "ods/picture/save.h"

namespace ods {

inline SaveOptions options_for(Layout layout) {
  SaveOptions options;
  options.layout = layout;
  options.tone = ToneCurve::kLinear;
  return options;
}

// How far codecs may be off, in linear light.
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
  }
  return 0.0f;
}

}  // namespace ods
