// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The one exception of the library: the outside world did not give what was needed, or the caller asked for what
// cannot be.
#pragma once
#include <stdexcept>
#include <string>

namespace ods {

// What was wrong decides the command's exit code.
enum class ErrorKind {
  kUsage,      // what was asked for makes no sense, contradicts itself or is not in the file that was named
  kInput,      // a file that is absent, broken or not supported
  kOutput,     // a file that could not be written
  kMemory,     // the machine has not enough
  kCancelled,  // Progress::cancelled said so
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
