// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/kept_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <span>
#include <vector>

#include "ods/files/atomic_file.h"
#include "ods/files/md5.h"
#include "ods/files/read_file.h"
#include "ods/sequence/identity.h"

namespace ods {

namespace {

// Identifies a frame's light by all that it depends on.
std::string light_key(const TexelRays& rays, const BakeOptions& options) {
  Settings settings = options.scene;
  const Settings of_samples = render_settings(options.render);
  settings.insert(settings.end(), of_samples.begin(), of_samples.end());
  const std::span bytes = std::as_bytes(std::span(rays.rays));
  return md5(settings_text(settings) + (options.is_denoised ? "denoised" : "") +
             md5({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

// Reads the light of an earlier run's textures: a key, and the colours of the texels that have rays. Returns whether it
// is that of this frame.
bool read_light(const std::string& path, const std::string& key, const std::vector<int>& owners, Image& light) {
  std::error_code fault;
  if (!std::filesystem::exists(path, fault)) return false;
  const size_t lit = static_cast<size_t>(std::ranges::count_if(owners, [](int owner) { return owner >= 0; }));
  const size_t size = key.size() + lit * 3 * sizeof(float);
  if (std::filesystem::file_size(path, fault) != size || fault) return false;
  const std::string bytes = read_text(path, size);
  if (!bytes.starts_with(key)) return false;
  size_t at = key.size();
  for (size_t i = 0; i < owners.size(); i++) {
    if (owners[i] < 0) continue;
    std::memcpy(&light.pixels[3 * i], bytes.data() + at, 3 * sizeof(float));
    at += 3 * sizeof(float);
  }
  return true;
}

void keep_light(const std::string& path, const std::string& key, const std::vector<int>& owners, const Image& light) {
  std::string bytes = key;
  for (size_t i = 0; i < owners.size(); i++) {
    if (owners[i] >= 0) bytes.append(reinterpret_cast<const char*>(&light.pixels[3 * i]), 3 * sizeof(float));
  }
  write_file(path, bytes);
}

}  // namespace

std::string unfinished_light(const std::string& path, size_t frame) {
  return fmt::format("{}.{}", path, frame);
}

std::string finished_light(const std::string& path, size_t frame) {
  return unfinished_light(path, frame) + ".light";
}

std::string still_light_file(const std::string& path) {
  return path + ".still";
}

Image kept_light(const Renderer& renderer, const std::shared_ptr<const TexelRays>& rays, const BakeOptions& options,
                 const std::string& kept, const Progress& progress) {
  if (kept.empty()) return bake(renderer, rays, options, progress);
  const std::string key = light_key(*rays, options);
  Image all(rays->width, rays->height, 3);
  if (read_light(kept, key, rays->owners, all)) return all;
  all = bake(renderer, rays, options, progress);
  keep_light(kept, key, rays->owners, all);
  return all;
}

}  // namespace ods
