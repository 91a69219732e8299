// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Items that are made one by one, worked on at once, and taken in their order.
//
// They live in a ring of ours, and oneTBB passes only pointers: it destroys no item that is on its way when a stage
// throws.
#pragma once
#include <tbb/parallel_pipeline.h>

#include <cstddef>
#include <vector>

namespace ods {

// `make(item)` fills an empty item, one at a time, and returns false when there are no more; `work(item)` runs for many
// items at once; `take(item)` gets them one at a time in the order in which they were made. At most `most` items exist
// at once. What a stage throws ends all of it, and comes out of here.
template <typename Item, typename Make, typename Work, typename Take>
void run_pipeline(size_t most, const Make& make, const Work& work, const Take& take) {
  std::vector<Item> ring(most);
  size_t next = 0;
  const auto first = [&](tbb::flow_control& control) -> Item* {
    Item* item = &ring[next++ % most];  // its last use is over: items are taken in their order
    if (!make(*item)) control.stop();
    return item;
  };
  const auto second = [&](Item* item) {
    work(*item);
    return item;
  };
  const auto third = [&](Item* item) {
    take(*item);
    *item = Item();
  };
  using tbb::filter_mode;
  tbb::parallel_pipeline(most, tbb::make_filter<void, Item*>(filter_mode::serial_in_order, first) &
                                   tbb::make_filter<Item*, Item*>(filter_mode::parallel, second) &
                                   tbb::make_filter<Item*, void>(filter_mode::serial_in_order, third));
}

}  // namespace ods
