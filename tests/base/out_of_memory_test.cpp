// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory that runs out at any moment: the caller gets std::bad_alloc or Error(kMemory), the process continues, and no
// partial file stays. This program's operator new fails where a test chooses, in every thread and every library.
#include <gtest/gtest.h>
#include <unistd.h>

#include <barrier>
#include <filesystem>
#include <functional>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/image/image_file.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "tests/base/failing_memory.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_folder.h"

// Read by the leak sanitizer: Embree keeps its threads' memory if it runs out while a tree is built.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libembree";
}

namespace ods {
namespace {

#ifdef __SANITIZE_ADDRESS__
class Sanitized : public testing::Environment {
  void SetUp() override { GTEST_SKIP() << "skipped: the address sanitizer has an operator new of its own"; }
};
[[maybe_unused]] testing::Environment* const kSanitized = testing::AddGlobalTestEnvironment(new Sanitized);
#endif

// Does the work again and again, with ever more allocations that succeed, until it gets through. lasts: after the first
// that fails all others do. Returns how often it failed.
int survive(const std::function<void()>& work, bool lasts, size_t bytes = 0) {
  work();  // what libraries make once is there
  int failures = 0;
  for (long n = 0; n < 1'000'000; n += 1 + n / 60) {
    fail_allocations(n, lasts, bytes);
    try {
      work();
      if (allow_allocations() == 0) return failures;
    } catch (const std::bad_alloc&) {
      allow_allocations();
    } catch (const Error& error) {
      allow_allocations();
      EXPECT_EQ(error.kind(), ErrorKind::kMemory) << "allocation " << n << ": " << error.what();
    } catch (const std::exception& error) {
      allow_allocations();
      ADD_FAILURE() << "allocation " << n << ": " << error.what();
    }
    failures++;
  }
  ADD_FAILURE() << "it never gets through";
  return failures;
}

// OpenEXR makes short strings where it has promised not to throw, which ends the process.
constexpr size_t kLibraries = 1024;

GltfBuilder make_scene() {
  GltfBuilder file = make_triangle();
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{"name": "a name that is longer than a short string holds",
      "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}, "extras": {"a": [0, {"b": [1, 2, 3]}]}}])");
  file.primitive()["material"] = 0;
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = GltfJson::parse(R"([{"type": "point"}])");
  file.node(0)["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const int times = file.add<float>({0, 1}, kFloat, "SCALAR");
  const int places = file.add<float>({0, 0, 0, 2, 0, 0}, kFloat, "VEC3");
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  return file;
}

class OutOfMemory : public testing::TestWithParam<bool> {};  // whether it lasts

TEST_P(OutOfMemory, LoadingAScene) {
  GltfBuilder file = make_scene();
  file.json["materials"][0].erase("emissiveTexture");
  const Binary bytes = file.glb();
  EXPECT_GT(survive([&] { load_gltf_bytes(bytes, "test.glb"); }, GetParam()), 50);
}

TEST_P(OutOfMemory, LoadingASceneWithAPicture) {
  const Binary bytes = make_scene().glb();
  EXPECT_GT(survive([&] { load_gltf_bytes(bytes, "test.glb"); }, GetParam(), kLibraries), 0);
}

TEST_P(OutOfMemory, LoadingAFileWithItsBufferBeside) {
  const TemporaryFolder folder;
  GltfBuilder file = make_scene();
  file.json["materials"][0].erase("emissiveTexture");
  file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "scene.bin"}}};
  folder.write("scene.bin", {file.binary.begin(), file.binary.end()});
  folder.write("scene.gltf", file.json.dump());
  EXPECT_GT(survive([&] { load_scene(folder.path("scene.gltf")); }, GetParam()), 50);
}

TEST_P(OutOfMemory, BrokenJson) {
  const std::string text = R"({"asset": {"version": "2.0"}, "nodes": [{}, {"a": [1, 2, 3)";
  const Binary bytes = make_glb(text, {});
  const auto work = [&] {
    try {
      load_gltf_bytes(bytes, "test.glb");
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
    }
  };
  EXPECT_GT(survive(work, GetParam()), 10);
}

TEST_P(OutOfMemory, Rendering) {
  const Scene scene = load_scene("furnace");
  RenderOptions options;
  options.width = 16, options.samples = 1, options.threads = 2;
  EXPECT_GT(survive([&] { render_cpu(scene, StereoCamera(), options); }, GetParam()), 10);
}

TEST_P(OutOfMemory, SavingAndOpeningPictures) {
  const Scene scene = load_scene("furnace");
  RenderOptions options;
  options.width = 64, options.samples = 1;
  const Picture picture = render_cpu(scene, StereoCamera(), options);
  for (const std::string name : {"a.png", "a.jpg", "a.exr", "a.tif", "a.hdr", "a.webp"}) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    const std::string path = folder.path(name);
    const size_t minimum = name == "a.exr" ? kLibraries : 0;
    const auto save = [&] {
      std::filesystem::remove(path);
      try {
        save_picture(picture, StereoCamera(), {}, path);
      } catch (...) {
        allow_allocations();
        EXPECT_TRUE(folder.names().empty());
        throw;
      }
    };
    EXPECT_GT(survive(save, GetParam(), minimum), 0);
    save();
    EXPECT_GT(survive([&] { read_image(path); }, GetParam(), minimum), 0);
    EXPECT_GT(survive([&] { open_picture(path); }, GetParam(), minimum), 0);
  }
}

// Acts as a library that allocates in a destructor.
void allocate_without_throwing() noexcept {
  fail_allocations(0, true);
  const std::vector<char> bytes(100);
  allow_allocations();
}

TEST(OutOfMemoryDeathTest, TheCommandSaysSoWhereNothingMayThrow) {
#ifdef ODS_SANITIZED
  GTEST_SKIP() << "skipped: a sanitizer ends the process in its own way";
#endif
  const auto allocate = [] { return allocate_without_throwing(), kExitOk; };
  EXPECT_EXIT(std::exit(run_to_exit_code(allocate)), testing::ExitedWithCode(1),
              "^ods: error: not enough memory; a smaller scene or picture needs less\n$");
  EXPECT_EXIT(_exit(run_to_exit_code([]() -> ExitCode {
                fail_allocations(0, true);
                throw std::bad_alloc();
              })),
              testing::ExitedWithCode(1), "^ods: error: not enough memory; a smaller scene or picture needs less\n$");
}

TEST(OutOfMemoryDeathTest, TheCommandNamesItsFiles) {
  EXPECT_EXIT(_exit(run_to_exit_code([]() -> ExitCode {
                name_inputs({"a.png", "b.png"});
                fail_allocations(0, true);
                throw std::bad_alloc();
              })),
              testing::ExitedWithCode(1),
              "^ods: error: not enough memory for 'a.png', 'b.png'; a smaller scene or picture needs less\n$");
}

TEST(OutOfMemoryDeathTest, TheCommandSaysThatNoThreadStarts) {
  EXPECT_EXIT(_exit(run_to_exit_code([]() -> ExitCode { throw std::system_error(EAGAIN, std::generic_category()); })),
              testing::ExitedWithCode(1), "^ods: error: cannot start a thread");
}

// Acts as oneTBB, which starts threads where it must not throw.
void start_thread() {
  throw std::system_error(EAGAIN, std::generic_category(), "pthread_create");
}

void start_without_throwing() noexcept {
  start_thread();
}

TEST(OutOfMemoryDeathTest, ThreadsThatRunOutTogetherGiveOneLine) {
#ifdef ODS_SANITIZED
  GTEST_SKIP() << "skipped: a sanitizer ends the process in its own way";
#endif
  constexpr int kThreads = 16;
  const auto run_out = []() -> ExitCode {
    std::barrier together(kThreads);
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; i++) {
      threads.emplace_back([&, i] {
        together.arrive_and_wait();
        i % 2 == 0 ? start_without_throwing() : allocate_without_throwing();
      });
    }
    return threads.clear(), kExitOk;
  };
  for (int i = 0; i < 10; i++) {
    EXPECT_EXIT(_exit(run_to_exit_code(run_out)), testing::ExitedWithCode(1), "^ods: error: [^\n]*\n$");
  }
}

INSTANTIATE_TEST_SUITE_P(Once, OutOfMemory, testing::Values(false));
INSTANTIATE_TEST_SUITE_P(FromThenOn, OutOfMemory, testing::Values(true));

}  // namespace
}  // namespace ods
