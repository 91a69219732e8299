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

// Called when other processes make all remaining frames: the numbers of these frames, and the process that makes the
// first.
using OnWaiting = std::function<void(const std::vector<int>& numbers, const std::string& holder)>;

// Calls `make` with the index of every frame that is not saved yet and not claimed by another process. Then waits until
// the frames of other processes are saved; a frame whose process died is made here. So all frames exist on return.
// Throws Error(kOutput), and anything that `make` throws.
void make_shared_frames(const std::vector<SharedFrame>& frames, const std::function<void(size_t index)>& make,
                        const OnWaiting& waiting = {});

// Waits until all frames are saved, for at most `seconds`: network disks show other machines' files late. waiting:
// called once with the number of missing frames.
void wait_for_frames(const std::vector<SharedFrame>& frames, float seconds,
                     const std::function<void(size_t missing)>& waiting = {});

// Removes a stale claim from a frame whose process was killed just after saving it.
void remove_dead_claim(const std::string& path);

}  // namespace ods
