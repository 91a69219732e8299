// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/keyframes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ods {

static void make_unit(std::span<double> q) {
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const bool sound = std::isfinite(size) && size > 1e-100;
  for (size_t i = 0; i < 4; i++) q[i] = sound ? q[i] / size : (i == 3 ? 1.0 : 0.0);
}

static void slerp(const float* a, const float* b, double t, std::span<double> out) {
  double from[4], to[4];
  for (size_t i = 0; i < 4; i++) from[i] = static_cast<double>(a[i]), to[i] = static_cast<double>(b[i]);
  make_unit(from);
  make_unit(to);
  double cosine = 0.0;
  for (size_t i = 0; i < 4; i++) cosine += from[i] * to[i];
  const double side = cosine < 0.0 ? -1.0 : 1.0;  // q and -q are the same rotation; this selects the closer one
  const double angle = std::acos(std::min(std::abs(cosine), 1.0));
  double share_a = 1.0 - t, share_b = t;
  if (angle > 1e-6) {
    share_a = std::sin((1.0 - t) * angle) / std::sin(angle);
    share_b = std::sin(t * angle) / std::sin(angle);
  }
  for (size_t i = 0; i < 4; i++) out[i] = share_a * from[i] + share_b * side * to[i];
  make_unit(out);
}

// t: 0..1 between keys that are `span` seconds apart.
static double hermite(double a, double out_a, double b, double in_b, double span, double t) {
  const double t2 = t * t, t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * a + span * (t3 - 2.0 * t2 + t) * out_a + (3.0 * t2 - 2.0 * t3) * b +
         span * (t3 - t2) * in_b;
}

void evaluate(const Keyframes& keys, double seconds, std::span<double> out) {
  const size_t width = keys.width, count = keys.times.size();
  const bool cubic = keys.interpolation == Interpolation::kCubicSpline;
  assert(count > 0 && out.size() == width && keys.values.size() == count * width * (cubic ? 3 : 1));
  const auto after = std::upper_bound(keys.times.begin(), keys.times.end(), seconds,
                                      [](double t, float key) { return t < static_cast<double>(key); });
  const size_t next = static_cast<size_t>(after - keys.times.begin());
  const size_t a = next == 0 ? 0 : next - 1, b = std::min(next, count - 1);
  const float *from = keys.values.data() + a * width, *to = keys.values.data() + b * width;
  if (cubic) from = keys.values.data() + (3 * a + 1) * width, to = keys.values.data() + (3 * b + 1) * width;
  if (a == b || next == 0 || keys.interpolation == Interpolation::kStep) {
    for (size_t i = 0; i < width; i++) out[i] = static_cast<double>(from[i]);
    if (keys.rotation) make_unit(out);
    return;
  }
  const double start = static_cast<double>(keys.times[a]), span = static_cast<double>(keys.times[b]) - start;
  const double t = (seconds - start) / span;
  if (keys.rotation && !cubic) return slerp(from, to, t, out);
  for (size_t i = 0; i < width; i++) {
    const double p = static_cast<double>(from[i]), q = static_cast<double>(to[i]);
    out[i] = (1.0 - t) * p + t * q;
    if (cubic) {
      out[i] = hermite(p, static_cast<double>(from[width + i]), q, static_cast<double>(*(to + i - width)), span, t);
    }
  }
  if (keys.rotation) make_unit(out);
}

}  // namespace ods
