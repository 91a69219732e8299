// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/files/confined_file.h"
#include "ods/files/read_file.h"
#include "ods/picture/channel_layers.h"

namespace ods {

namespace {

constexpr std::string_view kMatteAttributes = "cryptomatte/";  // prefix of its attributes' names
constexpr const char* kManifest = "manifest";
constexpr const char* kManifestFile = "manif_file";
constexpr const char* kOwnLayer = "CryptoObject";

// The names of a manifest: {"name": "hexadecimal number", ...}.
std::map<float, std::string> read_manifest(const std::string& text) {
  std::map<float, std::string> names;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return names;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_string()) continue;
    const std::string& digits = value.get_ref<const std::string&>();
    if (digits.empty() || digits.size() > 8 ||
        digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
      continue;
    }
    const auto number = std::bit_cast<float>(static_cast<uint32_t>(std::stoul(digits, nullptr, 16)));
    if (!std::isnan(number)) names[number] = name;
  }
  return names;
}

std::string manifest_text(const std::map<float, std::string>& names) {
  nlohmann::json manifest = nlohmann::json::object();
  for (const auto& [number, name] : names) manifest[name] = fmt::format("{:08x}", std::bit_cast<uint32_t>(number));
  return json_document(manifest);
}

}  // namespace

// Source: Appleby, MurmurHash3_x86_32, in the public domain.
uint32_t murmur3(std::string_view text) {
  const auto mixed = [](uint32_t block) { return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u; };
  const auto byte_at = [&](size_t i) { return static_cast<uint32_t>(static_cast<unsigned char>(text[i])); };
  uint32_t hash = 0;
  size_t at = 0;
  for (; at + 4 <= text.size(); at += 4) {
    const uint32_t block = byte_at(at) | byte_at(at + 1) << 8 | byte_at(at + 2) << 16 | byte_at(at + 3) << 24;
    hash = std::rotl(hash ^ mixed(block), 13) * 5u + 0xe6546b64u;
  }
  uint32_t rest = 0;
  for (size_t i = text.size(); i > at; i--) rest = rest << 8 | byte_at(i - 1);
  if (at < text.size()) hash ^= mixed(rest);
  hash ^= static_cast<uint32_t>(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

float matte_number(std::string_view name) {
  uint32_t hash = murmur3(name);
  const uint32_t exponent = hash >> 23 & 0xffu;
  if (exponent == 0u || exponent == 0xffu) hash ^= 1u << 23;
  return std::bit_cast<float>(hash);
}

// The names of a manifest that is a file: NAME.json, not hidden, beside the picture. None if it cannot be read.
static std::map<float, std::string> names_beside(const std::string& picture, const std::string& name) {
  constexpr size_t kMaxBytes = size_t{64} << 20u;
  if (name.find('/') != std::string::npos || name.starts_with('.') || !small_letters(name).ends_with(".json"))
    return {};
  try {
    const std::filesystem::path folder = std::filesystem::canonical(picture).parent_path();
    const ConfinedFile file((folder / name).string(), folder.string(), Reach::kDirectly);
    const std::vector<unsigned char> bytes =
        file.read([](const std::string& opened) { return read_file(opened, kMaxBytes); });
    return read_manifest({bytes.begin(), bytes.end()});
  } catch (const Error&) {
  } catch (const std::filesystem::filesystem_error&) {
  }
  return {};
}

// The names of the Cryptomatte whose attributes begin like this, "cryptomatte/3ae39a5/".
static std::map<float, std::string> names_of(const FileInfo& info, const std::string& key, const std::string& picture) {
  const auto own = info.text.find(key + kManifest), file = info.text.find(key + kManifestFile);
  std::map<float, std::string> names;
  if (own != info.text.end()) names = read_manifest(own->second);
  if (names.empty() && file != info.text.end()) names = names_beside(picture, file->second);
  return names;
}

std::optional<Cryptomatte> find_cryptomatte(const FileInfo& info, const std::string& path) {
  std::optional<Cryptomatte> found;
  for (const auto& [attribute, layer] : info.text) {
    if (!attribute.starts_with(kMatteAttributes) || !attribute.ends_with("/name")) continue;
    const bool is_better = !found || small_letters(layer).find("object") != std::string::npos;
    if (is_better) found = Cryptomatte{layer, names_of(info, attribute.substr(0, attribute.size() - 4), path)};
  }
  return found;
}

std::vector<Attribute> matte_attributes(const FileInfo& info, const std::string& path) {
  std::vector<Attribute> attributes;
  for (const auto& [name, text] : info.text) {
    if (!name.starts_with(kMatteAttributes)) continue;
    const std::string key = name.substr(0, name.rfind('/') + 1);
    const bool is_file = name == key + kManifestFile && !info.text.contains(key + kManifest);
    const std::map<float, std::string> names = is_file ? names_of(info, key, path) : std::map<float, std::string>();
    attributes.push_back(names.empty() ? Attribute{name, text} : Attribute{key + kManifest, manifest_text(names)});
  }
  return attributes;
}

// The first rank of the first layer: `LAYER00.R`, in some files `LAYER00.r`.
static bool is_matte(const LayerPixels& layer, const std::string& channel, const Cryptomatte& matte) {
  const auto [group, last] = split_name(channel);
  return group == matte.layer + "00" && small_letters(last) == "r" && layer.sample == SampleType::kFloat;
}

std::string matte_channel(const StoredPicture& picture, const Cryptomatte& matte) {
  for (const LayerPixels& layer : picture.eyes[0].layers) {
    for (const std::string& channel : layer.channels) {
      if (is_matte(layer, channel, matte)) return channel;
    }
  }
  return "";
}

Image matte_of_eye(const StoredPicture& picture, size_t eye, const Cryptomatte& matte) {
  for (const LayerPixels& layer : picture.eyes[eye].layers) {
    for (size_t channel = 0; channel < layer.channels.size(); channel++) {
      if (!is_matte(layer, layer.channels[channel], matte)) continue;
      Image numbers(picture.size.width, picture.size.height, 1);
      for (int y = 0; y < numbers.height; y++) {
        for (int x = 0; x < numbers.width; x++) {
          std::memcpy(numbers.at(x, y), layer.first + y * layer.row_stride + x * layer.pixel_stride + 4 * channel, 4);
        }
      }
      return numbers;
    }
  }
  return {};
}

void add_cryptomatte(PictureRows& rows, SaveOptions& save, std::vector<Image> numbers,
                     const std::vector<std::string>& names) {
  std::map<float, std::string> numbered;
  for (const std::string& name : names) {
    if (!name.empty()) numbered[matte_number(name)] = name;
  }
  const std::string key = fmt::format("{}{:07x}/", kMatteAttributes, murmur3(kOwnLayer) >> 4);
  save.attributes.push_back({key + "name", std::string(kOwnLayer)});
  save.attributes.push_back({key + "hash", std::string("MurmurHash3_32")});
  save.attributes.push_back({key + "conversion", std::string("uint32_to_float32")});
  save.attributes.push_back({key + kManifest, manifest_text(numbered)});
  const size_t before = count_channels(rows.layers);
  RowLayer layer{{}, LayerRule::kNearest, SampleType::kFloat};
  for (const char* channel : {"R", "G", "B", "A"}) layer.channels.push_back(fmt::format("{}00.{}", kOwnLayer, channel));
  rows.layers.push_back(layer);
  const auto all = std::make_shared<const std::vector<Image>>(std::move(numbers));
  rows.fill = [fill = std::move(rows.fill), all, before](int index, int y, std::span<float> row) {
    const Image& own = (*all)[static_cast<size_t>(index)];
    const size_t stride = before + 4, width = static_cast<size_t>(own.width);
    fill(index, y, row.first(before * width));
    // From the last pixel backwards, because pixels move to the right.
    for (size_t x = width; x-- > 0;) {
      std::copy_backward(&row[x * before], &row[x * before] + before, &row[x * stride] + before);
      const float number = *own.at(static_cast<int>(x), y);
      const float ranks[] = {number, number == 0.0f ? 0.0f : 1.0f, 0.0f, 0.0f};
      std::copy_n(ranks, 4, &row[x * stride + before]);
    }
  };
}

}  // namespace ods
