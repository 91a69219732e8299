// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Other programs, started.
#pragma once
#include <optional>
#include <string>
#include <vector>

// This very program, as a word to spawn().
inline constexpr const char* kThisProgram = "/proc/self/exe";

enum class StreamUse { kRead, kShown, kHidden };

struct Spawned {
  int process = 0;  // to be waited for
  int from = -1;    // where its streams that are kRead can be read; to be closed
};

// words: the program, by its path or as PATH finds it, and its arguments. Nothing if it cannot be started.
std::optional<Spawned> spawn(const std::vector<std::string>& words, StreamUse out, StreamUse errors);

// The same, of which stderr is read and stdout hidden. It is killed when the calling thread ends, whatever ends that,
// and the terminal's Ctrl-C is not for it.
std::optional<Spawned> spawn_for_this_thread(const std::vector<std::string>& words);
