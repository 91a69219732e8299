// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames rendered by several processes together, on one machine or many:
// the process that claims a frame makes it (ods/files/claim.h).
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace ods {

struct SharedFrame {
  int number = 0;
  std::string path;  // as for is_saved()
};

// Called when the rest is being made by others: the numbers of these frames, and who makes the first of them.
using OnWaiting = std::function<void(const std::vector<int>& numbers, const std::string& holder)>;

// Calls `make` with the index of every frame that is not saved yet and not claimed by another process. Then waits until
// those of others are saved; a frame whose process died is made here. So all frames exist on return. Throws
// Error(kOutput), and what `make` throws.
void make_shared_frames(const std::vector<SharedFrame>& frames, const std::function<void(size_t index)>& make,
                        const OnWaiting& waiting = {});

// Waits until all frames are saved, at most so many seconds: network disks show other machines' files late. waiting:
// is told once how many are missing.
void wait_for_frames(const std::vector<SharedFrame>& frames, float seconds,
                     const std::function<void(size_t missing)>& waiting = {});

// Removes a stale claim from a frame whose process was killed just after saving it.
void remove_dead_claim(const std::string& path);

}  // namespace ods
