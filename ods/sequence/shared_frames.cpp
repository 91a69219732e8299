// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/shared_frames.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numeric>
#include <thread>

#include "ods/files/claim.h"
#include "ods/picture/save.h"

namespace ods {

void make_shared_frames(const std::vector<SharedFrame>& frames, const std::function<void(size_t index)>& make,
                        const OnWaiting& waiting) {
  std::vector<size_t> open(frames.size());
  std::iota(open.begin(), open.end(), size_t{0});
  size_t said = 0;  // the number of frames in the last message
  while (!open.empty()) {
    std::vector<size_t> others;
    std::string holder, first;
    for (const size_t i : open) {
      if (is_saved(frames[i].path)) {
        remove_dead_claim(frames[i].path);
        continue;
      }
      if (const std::unique_ptr<Claim> own = try_claim(frames[i].path, holder)) {
        if (!is_saved(frames[i].path)) make(i);  // its previous owner may have saved it just now
        continue;
      }
      if (others.empty()) first = holder;
      others.push_back(i);
    }
    const bool waits = others.size() == open.size();
    open = std::move(others);
    if (!waits) continue;
    if (open.size() != said && waiting) {
      std::vector<int> numbers;
      for (const size_t i : open) numbers.push_back(frames[i].number);
      waiting(numbers, first);
    }
    said = open.size();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
}

void wait_for_frames(const std::vector<SharedFrame>& frames, float seconds,
                     const std::function<void(size_t missing)>& waiting) {
  if (seconds <= 0.0f) return;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<float>(seconds);
  std::vector<SharedFrame> missing = frames;
  bool said = false;
  while (true) {
    std::erase_if(missing, [](const SharedFrame& frame) { return is_saved(frame.path); });
    if (missing.empty() || std::chrono::steady_clock::now() >= end) return;
    if (!said && waiting) waiting(missing.size());
    said = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    std::error_code ignored;  // reading the folder makes a client of NFS look again
    const std::filesystem::path folder = std::filesystem::absolute(missing.front().path, ignored).parent_path();
    std::filesystem::directory_iterator(folder, ignored);
  }
}

void remove_dead_claim(const std::string& path) {
  std::error_code ignored;
  std::string holder;
  if (std::filesystem::exists(claim_path(path), ignored)) try_claim(path, holder);
}

}  // namespace ods
