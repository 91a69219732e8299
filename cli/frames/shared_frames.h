// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames rendered by several processes together, on one machine or many:
// the process that claims a frame makes it (ods/files/claim.h).
#pragma once
#include <functional>
#include <string>
#include <vector>

struct SharedFrame {
  int number = 0;
  std::string path;  // as for ods::is_saved()
};

// Calls `make` with the index of every frame that is not saved yet and not claimed by another process. Then lists the
// frames (`noun`: "frame", or what they are) that others are still making, and waits until those are saved; a frame
// whose process died is made here. So all frames exist on return. Throws ods::Error(kOutput), and what `make` throws.
void make_shared_frames(const std::vector<SharedFrame>& frames, const std::string& noun,
                        const std::function<void(size_t index)>& make);

// Waits until all frames are saved, at most so many seconds: network disks show other machines' files late. Says what
// it waits for.
void wait_for_frames(const std::vector<SharedFrame>& frames, const std::string& noun, float seconds);

// Removes a stale claim from a frame whose process was killed just after saving it.
void remove_dead_claim(const std::string& path);
