// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The kind of an option's value or an argument: its name in help, and whether it names a file or a folder. It is set
// where the option is added, and used by the manual, the shells' completion and ods submit.
#pragma once
#include <functional>
#include <string>
#include <utility>

enum class PathUse { kNone, kInput, kOutput };

struct ValueKind {
  using Judge = std::function<bool(const std::string&)>;

  // No path. Implicit, as most are: "N", "X,Y,Z", "draft|preview|final"; empty for a flag.
  ValueKind(const char* name) : unit(name) {}
  ValueKind(std::string name) : unit(std::move(name)) {}

  // judge: returns whether a value is a path, for values that may be something else.
  static ValueKind input_file(std::string name = "FILE", Judge judge = {}) {
    return {std::move(name), PathUse::kInput, false, std::move(judge)};
  }
  static ValueKind input_folder() { return {"DIR", PathUse::kInput, true, {}}; }
  static ValueKind output_file() { return {"FILE", PathUse::kOutput, false, {}}; }
  static ValueKind output_folder() { return {"DIR", PathUse::kOutput, true, {}}; }

  PathUse use_of(const std::string& value) const { return !judge || judge(value) ? use : PathUse::kNone; }

  std::string unit;
  PathUse use = PathUse::kNone;
  bool is_folder = false;
  Judge judge;

 private:
  ValueKind(std::string name, PathUse how, bool folder, Judge judge_of)
      : unit(std::move(name)), use(how), is_folder(folder), judge(std::move(judge_of)) {}
};
