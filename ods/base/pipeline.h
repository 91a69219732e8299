// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Items that are made one by one, worked on at once, and taken in their order.
//
// They live in a ring of ours, and oneTBB passes only their places: it destroys nothing that is on its way when a
// stage throws.
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace ods {

// The same of the places of a ring of `most` items, by their index.
void run_ring(size_t most, const std::function<bool(size_t place)>& make, const std::function<void(size_t place)>& work,
              const std::function<void(size_t place)>& take);

// `make(item)` fills an empty item, one at a time, and returns false when there are no more; `work(item)` runs for many
// items at once; `take(item)` gets them one at a time in the order in which they were made. At most `most` items exist
// at once. What a stage throws ends all of it, and comes out of here.
template <typename Item, typename Make, typename Work, typename Take>
void run_pipeline(size_t most, const Make& make, const Work& work, const Take& take) {
  std::vector<Item> ring(most);
  const auto take_away = [&](size_t place) {
    take(ring[place]);
    ring[place] = Item();
  };
  run_ring(
      most, [&](size_t place) { return make(ring[place]); }, [&](size_t place) { work(ring[place]); }, take_away);
}

}  // namespace ods
