// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames that several processes make together, on one machine or many: each frame is made by the process that claims it
// (ods/files/claim.h).
#pragma once
#include <functional>
#include <string>
#include <vector>

struct SharedFrame {
  int number = 0;
  std::string path;  // as ods::is_saved() takes it
};

// Calls `make` with the index of every frame that is not saved yet and that no other process makes. Then names the
// frames (`noun`: "frame", or what they are) that others are still making, and waits until they are saved; a frame
// whose process died is made here. So all frames are there when it returns. Throws ods::Error(kOutput), and what `make`
// throws.
void make_shared_frames(const std::vector<SharedFrame>& frames, const std::string& noun,
                        const std::function<void(size_t index)>& make);

// Removes the claim that a process left on a frame when it was killed just after saving it.
void remove_dead_claim(const std::string& path);
