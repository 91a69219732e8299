// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/checksum.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

TEST(Checksum, IsThatOfZip) {
  EXPECT_EQ(crc32("123456789"), 0xcbf43926u);  // the check value of CRC-32 (ISO-HDLC)
}

TEST(Checksum, GoesOnInPieces) {
  EXPECT_EQ(crc32("456789", crc32(std::string_view(), crc32("123"))), 0xcbf43926u);
  EXPECT_EQ(crc32(std::span<const std::byte>(), 5u), 5u);
}

}  // namespace
}  // namespace ods
