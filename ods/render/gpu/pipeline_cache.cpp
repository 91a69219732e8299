// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/pipeline_cache.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "ods/base/checksum.h"
#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/files/private_folder.h"

namespace ods {

PipelineCacheFile::PipelineCacheFile(std::string folder, std::span<const uint8_t, 16> uuid)
    : folder_(std::move(folder)) {
  if (folder_.empty()) return;
  path_ = folder_ + "/";
  for (const uint8_t byte : uuid) path_ += fmt::format("{:02x}", byte);
}

std::vector<std::byte> PipelineCacheFile::read() const {
  if (path_.empty()) return {};
  std::ifstream file(path_, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  uint32_t sum = 0;
  if (bytes.size() <= sizeof(sum)) return {};
  std::memcpy(&sum, bytes.data(), sizeof(sum));
  const std::span data(reinterpret_cast<const std::byte*>(bytes.data()) + sizeof(sum), bytes.size() - sizeof(sum));
  if (crc32(data) != sum) return {};
  return {data.begin(), data.end()};
}

void PipelineCacheFile::write(std::span<const std::byte> data) const {
  if (path_.empty()) return;
  try {
    make_own_folder(folder_);
    AtomicFile file(path_);
    const uint32_t sum = crc32(data);
    file.write(&sum, sizeof(sum));
    file.write(data.data(), data.size());
    file.commit();
  } catch (const Error&) {
  }
}

}  // namespace ods
