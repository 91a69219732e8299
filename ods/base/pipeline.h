// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Produces items one by one, processes them in parallel, and consumes them in order.
//
// The items are in our own ring buffer and oneTBB passes only indices, because it does not destroy items in flight when
// a stage throws.
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace ods {

// Runs the stages of run_pipeline() on the slots of a ring of `maximum` items.
void run_ring(size_t maximum, const std::function<bool(size_t place)>& make,
              const std::function<void(size_t place)>& work, const std::function<void(size_t place)>& take);

// `make(item)` fills an empty item, one call at a time, and returns false at the end; `work(item)` runs on many items
// in parallel; `take(item)` receives them one at a time in the order they were made. At most `maximum` items exist at
// once. An exception from any stage stops the pipeline and is rethrown here.
template <typename Item, typename Make, typename Work, typename Take>
void run_pipeline(size_t maximum, const Make& make, const Work& work, const Take& take) {
  std::vector<Item> ring(maximum);
  const auto take_away = [&](size_t place) {
    take(ring[place]);
    ring[place] = Item();
  };
  run_ring(
      maximum, [&](size_t place) { return make(ring[place]); }, [&](size_t place) { work(ring[place]); }, take_away);
}

}  // namespace ods
