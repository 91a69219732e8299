// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/light_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "ods/kernel/path.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

std::vector<CacheDeposit> some_deposits(int count) {
  Dice dice(7);
  std::vector<CacheDeposit> deposits;
  for (int i = 0; i < count; i++) {
    CacheDeposit deposit;
    deposit.place.position = vec3(dice.between(-2, 2), dice.between(-2, 2), dice.between(-2, 2));
    deposit.place.normal = vec3(0, dice.next() < 0.5f ? -1.0f : 1.0f, 0);
    deposit.place.albedo = vec3(dice.between(0.1f, 1.0f), 0.5f, 0.5f);
    deposit.place.cell = 0.5f;
    deposit.light = deposit.place.albedo * dice.between(0.0f, 6.0f);
    deposit.odd_path = i % 2 == 1;
    deposits.push_back(deposit);
  }
  return deposits;
}

bool same(const std::vector<CacheCell>& a, const std::vector<CacheCell>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const CacheCell& x, const CacheCell& y) {
    return x.home == y.home && x.check == y.check && x.light == y.light;
  });
}

TEST(LightCacheSums, OrderAndGrowthChangeNothing) {
  std::vector<CacheDeposit> deposits = some_deposits(50000);
  LightCacheSums first;
  first.reserve(2 * deposits.size());
  for (const CacheDeposit& deposit : deposits) first.add(deposit);
  std::shuffle(deposits.begin(), deposits.end(), std::mt19937(3));
  LightCacheSums second;
  for (size_t i = 0; i < deposits.size(); i++) {
    if (i % 1000 == 0) second.reserve(2000);
    second.add(deposits[i]);
  }
  EXPECT_TRUE(same(first.table(), second.table()));
  EXPECT_EQ(first.error(), second.error());
  EXPECT_GT(first.error(), 0.0);
}

// The light over albedo of a cell is the mean of what was added, and cells that were met rarely are not in the table.
TEST(LightCacheSums, KeepsTheMean) {
  LightCacheSums sums;
  sums.reserve(100);
  CacheDeposit deposit;
  deposit.place = {vec3(0.1f), vec3(0, 1, 0), vec3(0.2f), 1.0f};
  for (int i = 0; i < 20; i++) {
    deposit.light = vec3(0.2f) * (i % 2 == 0 ? 1.0f : 3.0f);
    sums.add(deposit);
  }
  deposit.place.position = vec3(5.1f);
  sums.add(deposit);
  int cells = 0;
  for (const CacheCell& cell : sums.table()) {
    if (cell.check == 0) continue;
    cells++;
    EXPECT_NEAR(cell.light.x, 2.0f, 1e-3f);
  }
  EXPECT_EQ(cells, 2);  // one in the other
}

// Neighbouring places, other sizes and other sides have other names.
TEST(LightCacheKey, NamesEveryCellApart) {
  std::set<std::pair<uint, uint>> names;
  std::set<uint> homes;
  int cells = 0;
  for (int x = -20; x < 20; x++) {
    for (int y = -20; y < 20; y++) {
      for (int z = -20; z < 20; z++) {
        for (const float size : {0.25f, 0.5f}) {
          for (const float side : {-1.0f, 1.0f}) {
            CachePlace place;
            place.position = (vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) + 0.3f) * size;
            place.normal = vec3(0, 0, side);
            const CacheKey key = cache_key(place, size);
            names.insert({key.home, key.check});
            homes.insert(key.home);
            cells++;
          }
        }
      }
    }
  }
  EXPECT_EQ(names.size(), static_cast<size_t>(cells));
  EXPECT_GT(homes.size(), static_cast<size_t>(cells) * 99 / 100);
}

// A table without an empty slot must not hang a device.
TEST(LightCacheReader, ASearchInAFullTableEnds) {
  std::vector<CacheCell> full(4, CacheCell{1, 3, vec3(0.5f)});
  PathTracer tracer;
  tracer.cache_cells = full.data();
  tracer.cache_mask = 3;
  EXPECT_EQ(tracer.light_in_cell({6, 5}).x, -1.0f);
  full[1] = {6, 5, vec3(0.25f)};  // found after the end of the table
  EXPECT_EQ(tracer.light_in_cell({6, 5}).x, 0.25f);
}

}  // namespace
}  // namespace ods
