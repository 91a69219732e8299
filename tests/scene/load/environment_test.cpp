// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/load/environment.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

TEST(Environment, RadianceIsReadAndRepaired) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> values = {1.0f, 2.5f, 1000.0f, nan, -1.0f, infinity};  // two texels
  const TemporaryFolder folder;
  const std::string path = folder.path("sky.exr");
  FileHeader header;
  header.format = FileFormat::kExr;
  header.width = 2;
  header.height = 1;
  for (const char* name : {"R", "G", "B"}) header.channels.push_back({name, SampleType::kFloat});
  AtomicFile file(path);
  write_image(file, header, [&](int, std::span<float> row) { std::copy(values.begin(), values.end(), row.begin()); });
  file.commit();

  const Environment environment = load_environment(path);
  EXPECT_EQ(environment.width, 2);
  EXPECT_EQ(environment.height, 1);
  EXPECT_EQ(environment.radiance, vec3(1.0f));
  ASSERT_EQ(environment.texels.size(), 2u);
  EXPECT_EQ(environment.texels[0], vec3(1.0f, 2.5f, 1000.0f));
  EXPECT_EQ(environment.texels[1], vec3(0.0f, 0.0f, 65504.0f));
  std::filesystem::remove(path);
  EXPECT_THROW(load_environment(path), Error);
}

}  // namespace
}  // namespace ods
