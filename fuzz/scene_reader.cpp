// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the glTF reader: any bytes give a Scene that satisfies its guarantees at every time, or ods::Error.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_scene_reader
//   fuzz/make_seeds.py build/corpus
//   build/fuzz/fuzz_scene_reader -dict=fuzz/gltf.dict -max_len=65536 build/corpus
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/scene/gltf/gltf.h"
#include "ods/scene/motion.h"
#include "tests/support/scene_check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    ods::Scene scene = ods::load_gltf_bytes({data, size}, "no-such-folder/fuzz.glb");
    if (!ods::broken_promise(scene).empty()) std::abort();
    ods::play(scene.animation, "");
    for (const double time : {0.0, 0.4, 1e6}) {
      ods::set_time(scene, time);
      if (!ods::broken_promise(scene).empty()) std::abort();
    }
  } catch (const ods::Error&) {
  }
  return 0;
}
