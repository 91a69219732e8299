// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// PNG files made in memory.
#pragma once
#include <string>

#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_folder.h"

namespace ods {

// channels: of R, G, B, A. value(x, y, c): 0..1 of the code range.
inline Binary make_png(int width, int height, const std::string& channels, SampleType sample,
                       const std::function<float(int x, int y, int c)>& value) {
  const TemporaryFolder folder;
  AtomicFile file(folder.path("file.png"));
  FileHeader header;
  header.format = FileFormat::kPng;
  header.width = width;
  header.height = height;
  for (const char name : channels) header.channels.push_back({std::string(1, name), sample});
  const int count = static_cast<int>(channels.size());
  write_image(file, header, [&](int y, std::span<float> row) {
    for (int i = 0; i < width * count; i++) row[static_cast<size_t>(i)] = value(i / count, y, i % count);
  });
  file.commit();
  const std::string bytes = folder.read("file.png");
  return {bytes.begin(), bytes.end()};
}

// Adds a picture to a file and returns the index of a texture with it.
inline int add_texture(GltfBuilder& file, const Binary& png) {
  const int view = file.add_view(png);
  file.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
  file.json["textures"].push_back({{"source", file.json["images"].size() - 1}});
  return static_cast<int>(file.json["textures"].size()) - 1;
}

}  // namespace ods
