// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/light_cache.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace ods {
namespace {

constexpr double kUnit = 1 << 20;      // resolution of light
constexpr float kBrightest = 1 << 19;  // maximum light of one path
constexpr uint32_t kFewestPaths = 8;   // a cell that fewer paths have met is not used

uint64_t word_of(CacheKey key) {
  return uint64_t{key.home} << 32 | key.check;
}

CacheKey key_of(uint64_t word) {
  return {static_cast<uint>(word >> 32), static_cast<uint>(word)};
}

template <typename Number>
void add_to(Number& sum, Number value) {
  if (value != 0) std::atomic_ref(sum).fetch_add(value, std::memory_order_relaxed);
}

int64_t fixed(float light) {
  return light > 0.0f ? std::llrint(double{std::min(light, kBrightest)} * kUnit) : 0;
}

}  // namespace

int64_t light_cache_paths(const RenderOptions& options) {
  constexpr int64_t kSamplesPerPath = 16;  // per eye
  constexpr int64_t kFewest = 1 << 16, kMax = 1 << 22;
  constexpr double kPathsPerSecond = 2e4;  // for a time limit
  // With a single bounce no path meets a surface whose light could be cached.
  if (options.indirect != Indirect::kCache || options.bounces < 2) return 0;
  if (options.cache_paths > 0) return options.cache_paths;
  const int expected = options.noise > 0.0f ? options.samples / 4 : options.samples;  // most pixels are clean by then
  const int64_t share = int64_t{options.width} * options.height * expected / kSamplesPerPath;
  const int64_t maximum = options.time_limit > 0.0 ? std::llrint(options.time_limit * kPathsPerSecond) : kMax;
  return share < kFewest ? 0 : std::clamp(maximum, kFewest, std::min(share, kMax));
}

LightCacheSums::LightCacheSums() : slots_(size_t{1} << 16) {}

void LightCacheSums::reserve(size_t more) {
  used_ = static_cast<size_t>(std::count_if(slots_.begin(), slots_.end(), [](const Sums& s) { return s.key != 0; }));
  const size_t wanted = std::bit_ceil(2 * (used_ + more));
  if (wanted <= slots_.size()) return;
  std::vector<Sums> old(wanted);
  old.swap(slots_);
  for (const Sums& sums : old) {
    if (sums.key != 0) sums_of(key_of(sums.key)) = sums;
  }
}

LightCacheSums::Sums& LightCacheSums::sums_of(CacheKey key) {
  const uint64_t word = word_of(key);
  for (size_t slot = key.home;; slot++) {
    Sums& sums = slots_[slot & (slots_.size() - 1)];
    std::atomic_ref atomic(sums.key);
    uint64_t found = atomic.load(std::memory_order_relaxed);
    if (found == 0 && atomic.compare_exchange_strong(found, word, std::memory_order_relaxed)) return sums;
    if (found == word) return sums;
  }
}

void LightCacheSums::add(const CacheDeposit& deposit) {
  const int64_t bright = fixed(luminance(deposit.light));
  for (const float cell : {deposit.place.cell, 0.5f * deposit.place.cell}) {
    Sums& sums = sums_of(cache_key(deposit.place, cell));
    for (int c = 0; c < 3; c++) {
      add_to(sums.light[c], fixed(deposit.light[c]));
      add_to(sums.albedo[c], static_cast<uint32_t>(std::lrint(deposit.place.albedo[c] * 255.0f)));
    }
    if (deposit.odd_path) add_to(sums.odd_light, bright);
    add_to(sums.count, 1u);
  }
}

std::vector<const LightCacheSums::Sums*> LightCacheSums::cells_that_know() const {
  std::vector<const Sums*> cells;
  for (const Sums& sums : slots_) {
    if (sums.key != 0 && sums.count >= kFewestPaths) cells.push_back(&sums);
  }
  std::sort(cells.begin(), cells.end(), [](const Sums* a, const Sums* b) { return a->key < b->key; });
  return cells;
}

double LightCacheSums::brightness(const Sums& sums) {
  return 0.2126 * static_cast<double>(sums.light[0]) + 0.7152 * static_cast<double>(sums.light[1]) +
         0.0722 * static_cast<double>(sums.light[2]);
}

double LightCacheSums::error() const {
  double apart = 0.0, all = 0.0;
  for (const Sums* sums : cells_that_know()) {
    const double whole = brightness(*sums), odd = static_cast<double>(sums->odd_light);
    apart += (whole - 2.0 * odd) * (whole - 2.0 * odd) / sums->count;
    all += whole * whole / sums->count;
  }
  return all > 0.0 ? std::sqrt(apart / all) : 0.0;
}

std::vector<CacheCell> LightCacheSums::table() const {
  const std::vector<const Sums*> cells = cells_that_know();
  if (cells.empty()) return {};
  std::vector<CacheCell> table(std::bit_ceil(2 * cells.size()));
  for (const Sums* sums : cells) {
    const CacheKey key = key_of(sums->key);
    CacheCell cell{key.home, key.check, vec3(0.0f)};
    for (int c = 0; c < 3; c++) {
      const double albedo = sums->albedo[c] / 255.0;
      if (albedo > 0.0) cell.light[c] = static_cast<float>(static_cast<double>(sums->light[c]) / kUnit / albedo);
    }
    size_t slot = key.home & (table.size() - 1);
    while (table[slot].check != 0) slot = (slot + 1) & (table.size() - 1);
    table[slot] = cell;
  }
  return table;
}

}  // namespace ods
