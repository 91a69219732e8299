// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// --device on machines without Vulkan, with software Vulkan, and with a card that fails.
#include "cli/render/device.h"

#include <cstdlib>

#include "tests/support/cli_runner.h"

namespace ods::device_test {

// A variable of the environment of the commands that a test runs.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

class DeviceOption : public Cli {
 protected:
  // Expects that --device auto renders on the CPU for this reason, and that --device gpu is an error that names it.
  void expect_no_card(const std::string& reason) {
    EXPECT_EQ(run(render("--device auto")), 0) << err;
    EXPECT_NE(err.find("renders on the CPU: "), std::string::npos) << err;
    EXPECT_NE(err.find(reason), std::string::npos) << err;
    EXPECT_EQ(run(render("--device gpu")), 1) << err;
    EXPECT_NE(err.find("ods: error: --device gpu"), std::string::npos) << err;
    EXPECT_NE(err.find(reason), std::string::npos) << err;
    EXPECT_EQ(run("devices"), 0) << err;
    EXPECT_NE(out.find(reason), std::string::npos) << out;
  }
};

TEST_F(DeviceOption, WithoutTheLoader) {
  for (const char* name : {"libvulkan.so", "libvulkan.so.1"}) folder.write(name, "no library");
  const Variable libraries("LD_LIBRARY_PATH", folder.path(""));
  expect_no_card("libvulkan1");
}

TEST_F(DeviceOption, WithoutADriver) {
  if (run("devices") == 0 && out.find("libvulkan1") != std::string::npos) GTEST_SKIP() << "skipped: no libvulkan1";
  const Variable old_name("VK_ICD_FILENAMES", folder.path("none.json"));
  const Variable new_name("VK_DRIVER_FILES", folder.path("none.json"));
  expect_no_card("mesa-vulkan-drivers");
}

// The software device is named like this in every version of Mesa.
TEST_F(DeviceOption, SoftwareRendersIfItIsNamed) {
  ASSERT_EQ(run("devices"), 0) << err;
  if (out.find("llvmpipe") == std::string::npos) GTEST_SKIP() << "skipped: no mesa-vulkan-drivers";
  EXPECT_EQ(out.find("auto takes llvmpipe"), std::string::npos) << out;
  ASSERT_EQ(run(render("--device llvmpipe")), 0) << err;
  EXPECT_NE(err.find("renders on 'llvmpipe"), std::string::npos) << err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("picture.png")));
  EXPECT_EQ(run(render("--device llvmpipe --indirect cache")), 2) << err;
  EXPECT_NE(err.find("use --indirect path, or --device cpu"), std::string::npos) << err;
  EXPECT_EQ(run(render("--device llvmpipe --portable")), 2) << err;
}

TEST(FailedCard, IsReplacedByTheCpuIfAutoChoseIt) {
  const Error lost(ErrorKind::kDevice, "'card' stopped working");
  RenderJob job;
  job.render.gpu = 0;
  job.restart = true;
  job.device = "auto";
  EXPECT_TRUE(continues_on_cpu(job, lost));
  EXPECT_FALSE(continues_on_cpu(job, Error(ErrorKind::kOutput, "the disk is full")));
  const RenderJob after = on_cpu(job, lost);
  EXPECT_EQ(after.render.gpu, -1);
  EXPECT_FALSE(after.restart) << "it resumes";
  job.device = "gpu";
  EXPECT_FALSE(continues_on_cpu(job, lost));
}

}  // namespace ods::device_test
