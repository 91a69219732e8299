// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rows of OpenEXR files whose scanlines are packed by ZIP, which are most: read through OpenEXR's core with libdeflate
// in zlib's place, about three times as fast as OpenEXR alone (exr_rows.cpp alone knows the two). Other files
// are left to it. Source of the packing: OpenEXR, "Technical Introduction" and "OpenEXR File Layout".
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace ods {

class ExrRows {
 public:
  // The first part of a file; nullptr: it is no EXR that this is for, or damaged. `channels`: names in the order in
  // which they are wanted.
  static std::unique_ptr<ExrRows> open(const std::string& path, const std::vector<std::string>& channels);
  ~ExrRows();
  ExrRows(const ExrRows&) = delete;
  ExrRows& operator=(const ExrRows&) = delete;

  // The first `channels` channels of rows begin..end, counted from the top, one sample behind the other, every sample
  // as the file has it. Throws Error(kInput).
  void read(int begin, int end, size_t channels, std::byte* to) const;

 private:
  struct State;
  explicit ExrRows(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace ods
