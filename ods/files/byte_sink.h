// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The output of an encoder: a file (atomic_file.h) or memory.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace ods {

class ByteSink {
 public:
  virtual ~ByteSink() = default;

  // Writes at the current position and moves behind it. Never reports a failure: a file's finish() does.
  virtual void write(const void* bytes, size_t count) = 0;
  // Moves to a position, which may be behind the end: zeros fill the gap.
  virtual void seek(uint64_t position) = 0;
  virtual uint64_t position() const = 0;
  // Names the sink in messages.
  virtual const std::string& path() const = 0;
};

class MemorySink final : public ByteSink {
 public:
  // name: as path() returns it.
  explicit MemorySink(std::string name) : name_(std::move(name)) {}

  void write(const void* bytes, size_t count) override {
    if (count == 0) return;
    bytes_.resize(std::max<size_t>(bytes_.size(), position_ + count));
    std::memcpy(&bytes_[position_], bytes, count);
    position_ += count;
  }
  void seek(uint64_t position) override { position_ = position; }
  uint64_t position() const override { return position_; }
  const std::string& path() const override { return name_; }

  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string name_, bytes_;
  uint64_t position_ = 0;
};

}  // namespace ods
