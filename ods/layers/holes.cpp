// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/holes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "ods/base/error.h"
#include "ods/layers/layer_views.h"

namespace ods {

namespace {

constexpr int kRays = 1024;  // of a task

// The share of an eye's rays that meet the scene and no layer.
double share_of(const FirstHits& hits, const LayerViews::View& view) {
  const int count = static_cast<int>(view.directions.size());
  std::atomic<size_t> missing = 0;
  tbb::parallel_for(tbb::blocked_range(0, count, kRays), [&](const tbb::blocked_range<int>& range) {
    std::vector<FirstHit> seen(range.size());
    hits.look(view.place, &view.directions[static_cast<size_t>(range.begin())], static_cast<int>(range.size()),
              seen.data());
    for (size_t i = 0; i < seen.size(); i++) {
      if (seen[i].instance >= 0 && view.meshes[static_cast<size_t>(range.begin()) + i] < 0) missing++;
    }
  });
  return static_cast<double>(missing) / count;
}

}  // namespace

LayerHoles find_holes(const FirstHits& hits, const LayeredScene& layers, const Progress& progress) {
  const LayerViews views(layers);
  LayerHoles holes;
  double all = 0.0;
  for (int eye = 0; eye < LayerViews::kEyes; eye++) {
    const double share = share_of(hits, views.from_eye(eye));
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
    holes.worst = std::max(holes.worst, share);
    all += share;
    if (progress.report) progress.report(static_cast<double>(eye + 1) / LayerViews::kEyes);
  }
  holes.share = all / LayerViews::kEyes;
  return holes;
}

}  // namespace ods
