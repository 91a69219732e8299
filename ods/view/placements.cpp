// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/placements.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/base/decimal.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/files/atomic_file.h"
#include "ods/files/read_file.h"

namespace ods {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMaxPlacementsBytes = size_t{256} << 10;  // bytes
constexpr const char* kPlacements = "list of objects";

const Json& list_of(JsonReader& reader) {
  const Json* const list = reader.find("objects");
  if (!list || !list->is_array() || list->size() > kMaxPlacements) {
    reader.fail("objects", fmt::format("must be a list of at most {}", kMaxPlacements));
  }
  return *list;
}

void read_place(JsonReader& entry, Placement& placement) {
  std::vector<float> at;
  if (!entry.numbers("at", at, 3, -kFarthestPlacement, kFarthestPlacement)) entry.fail("at", "is missing");
  placement.at = {at[0], at[1], at[2]};
  entry.number("turn", placement.turn, -36000.0f, 36000.0f);
}

// A path as the file has it: relative if it is in the file's folder or below.
std::string stored_path(const std::string& file, const fs::path& folder) {
  std::error_code fault;
  if (!fs::exists(file, fault)) return file;  // a built-in scene
  const fs::path whole = fs::absolute(file, fault).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." ? whole.native() : relative.native();
}

fs::path folder_of(const std::string& layered) {
  std::error_code fault;
  return fs::absolute(layered, fault).lexically_normal().parent_path();
}

}  // namespace

std::string placements_path(const std::string& layered) {
  fs::path path(layered);
  path.replace_extension();
  if (small_letters(path.extension().native()) == ".layers") path.replace_extension();
  return path.native() + ".objects.json";
}

std::vector<Placement> read_placements(const std::string& layered) {
  const std::string name = placements_path(layered);
  std::error_code ignored;
  if (!fs::is_regular_file(name, ignored)) return {};
  const Json json = parse_json(read_text(name, kMaxPlacementsBytes), name, kPlacements);
  std::vector<std::string> warnings;
  JsonReader reader(json, name, kPlacements, "", warnings);
  std::vector<Placement> placements;
  for (const Json& each : list_of(reader)) {
    JsonReader entry(each, name, kPlacements, fmt::format("objects.{}", placements.size()), warnings);
    Placement& placement = placements.emplace_back();
    const Json* const file = entry.find("file");
    if (!file || !file->is_string() || file->get_ref<const std::string&>().empty()) {
      entry.fail("file", "must be the name of a scene");
    }
    placement.file = file->get<std::string>();
    if (!is_quotable(placement.file)) entry.fail("file", "must be the name of a scene");
    const fs::path beside = fs::path(layered).parent_path() / placement.file;
    if (fs::exists(beside, ignored)) placement.file = beside.native();
    read_place(entry, placement);
  }
  return placements;
}

std::string write_placements(const std::string& layered, std::span<const Placement> placements) {
  Json json = {{"objects", Json::array()}};
  for (const Placement& placement : placements) {
    const vec3 at = placement.at;
    json["objects"].push_back({{"file", stored_path(placement.file, folder_of(layered))},
                               {"at", {decimal(at.x), decimal(at.y), decimal(at.z)}},
                               {"turn", decimal(placement.turn)}});
  }
  const std::string name = placements_path(layered);
  write_file(name, json_document(json));
  return name;
}

void move_placements(const std::string& message, std::vector<Placement>& placements) {
  const std::string name = "the message";
  const Json json = parse_json(message, name, kPlacements);
  std::vector<std::string> warnings;
  JsonReader reader(json, name, kPlacements, "", warnings);
  const Json& list = list_of(reader);
  if (list.size() != placements.size()) reader.fail("objects", fmt::format("must be a list of {}", placements.size()));
  std::vector<Placement> moved = placements;
  for (size_t i = 0; i < moved.size(); i++) {
    JsonReader entry(list[i], name, kPlacements, fmt::format("objects.{}", i), warnings);
    read_place(entry, moved[i]);
  }
  placements = std::move(moved);
}

}  // namespace ods
