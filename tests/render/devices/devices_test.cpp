// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/devices/devices.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"

namespace ods {
namespace {

GpuList some_cards() {
  return {{{"llvmpipe", "Mesa", GpuKind::kSoftware, 1, ""},
           {"Old Card", "driver", GpuKind::kDiscrete, 1, "scalarBlockLayout"},
           {"Built In", "driver", GpuKind::kIntegrated, 1, ""},
           {"Big Card", "driver", GpuKind::kDiscrete, 1, ""}},
          ""};
}

TEST(Devices, AreChosenByWord) {
  const GpuList cards = some_cards();
  EXPECT_EQ(choose_among(cards, "cpu").gpu, -1);
  EXPECT_EQ(choose_among(cards, "gpu").gpu, 3);
  EXPECT_EQ(choose_among(cards, "auto").gpu, 3);
  EXPECT_EQ(choose_among(cards, "2").gpu, 2);
  EXPECT_EQ(choose_among(cards, "big").gpu, 3);
  EXPECT_THROW(choose_among(cards, "card"), Error);  // two
  EXPECT_THROW(choose_among(cards, "1"), Error);     // cannot render
  EXPECT_THROW(choose_among(cards, "7"), Error);
  EXPECT_THROW(choose_among(cards, "radeon"), Error);
}

TEST(Devices, SoftwareIsOnlyTakenIfAskedFor) {
  GpuList cards = some_cards();
  cards.gpus.resize(1);
  EXPECT_EQ(choose_among(cards, "gpu").gpu, 0);
  EXPECT_EQ(choose_among(cards, "auto").gpu, -1);
  EXPECT_EQ(choose_among({{}, "no loader"}, "auto").gpu, -1);
  EXPECT_THROW(choose_among({{}, "no loader"}, "gpu"), Error);
}

}  // namespace
}  // namespace ods
