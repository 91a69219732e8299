// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads rows of OpenEXR files whose scanlines are compressed by ZIP, which are most files: through OpenEXR's core with
// libdeflate instead of zlib, about three times as fast as OpenEXR alone (only exr_rows.cpp uses the two). Other files
// are left to OpenEXR. Source of the compression: OpenEXR, "Technical Introduction" and "OpenEXR File Layout".
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace ods {

class ExrRows {
 public:
  // Opens the first part of a file. Returns nullptr if it is not a supported EXR, or damaged. `channels`: names in the
  // wanted order.
  static std::unique_ptr<ExrRows> open(const std::string& path, const std::vector<std::string>& channels);
  ~ExrRows();
  ExrRows(const ExrRows&) = delete;
  ExrRows& operator=(const ExrRows&) = delete;

  // Reads the first `channels` channels of rows begin..end, counted from the top, one sample after the other, in the
  // file's sample type. Throws Error(kInput).
  void read(int begin, int end, size_t channels, std::byte* to) const;

 private:
  struct State;
  explicit ExrRows(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace ods
