// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/pipeline.h"

#include <tbb/parallel_pipeline.h>

namespace ods {

void run_ring(size_t maximum, const std::function<bool(size_t place)>& make,
              const std::function<void(size_t place)>& work, const std::function<void(size_t place)>& take) {
  size_t next = 0;
  const auto first = [&](tbb::flow_control& control) {
    const size_t place = next++ % maximum;  // free again: items are taken in order
    if (!make(place)) control.stop();
    return place;
  };
  const auto second = [&](size_t place) {
    work(place);
    return place;
  };
  using tbb::filter_mode;
  tbb::parallel_pipeline(maximum, tbb::make_filter<void, size_t>(filter_mode::serial_in_order, first) &
                                      tbb::make_filter<size_t, size_t>(filter_mode::parallel, second) &
                                      tbb::make_filter<size_t, void>(filter_mode::serial_in_order, take));
}

}  // namespace ods
