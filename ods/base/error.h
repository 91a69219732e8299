// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The library's only exception type: bad input from outside, or a request that cannot be fulfilled.
#pragma once
#include <stdexcept>
#include <string>

namespace ods {

// The kind decides the command's exit code.
enum class ErrorKind {
  kUsage,      // the request makes no sense, contradicts itself, or names something that the file does not contain
  kInput,      // a file is missing, malformed or unsupported
  kOutput,     // a file could not be written
  kMemory,     // not enough memory
  kDevice,     // a graphics card is missing, or failed
  kCancelled,  // Progress::cancelled returned true
};

// what() is one line: what happened, which file, what to try.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace ods
