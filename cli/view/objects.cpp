// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/convert/reproject.h"
#include "ods/view/objects/object_file.h"

using ods::ViewItem;

namespace {

bool shows_layers(const ViewItem& item) {
  return item.kind == ods::ItemKind::kLayers;
}

ods::ViewObject open_placed(const ods::Placement& placement) {
  ods::ObjectFile file = ods::make_object_file(open_object(placement.file, ""), placement.file);
  if (!file.note.empty()) note(file.note);
  ods::ViewObject object;
  object.placement = placement;
  object.name = std::filesystem::path(placement.file).filename().string();
  object.glb = std::make_shared<const std::string>(std::move(file.glb));
  return object;
}

bool shows_picture(const ViewItem& item) {
  return item.kind == ods::ItemKind::kPicture;
}

// A picture gets its stage.
void give_stage(ViewItem& item, const DepthInput& depth) {
  if (!shows_picture(item)) return;
  ods::OpenOptions open;
  open.format = item.known;
  ods::StoredPicture picture = ods::open_picture(item.path, open);
  if (!depth.path.empty()) give_depth(depth, picture);
  if (!ods::depth_layer(picture)) {
    throw UsageError(fmt::format(
        "'{}' has no depth, which --with needs: render it as .exr with depth, or add --depth FILE", item.path));
  }
  if (!picture.is_float) {
    note(fmt::format("'{}' has no light above white: its objects are lit by what it shows, lamps are too weak",
                     item.path));
  }
  item.stage = std::make_shared<const ods::PictureStage>(ods::make_stage(picture));
}

void add_kept(ViewItem& item, const DepthInput& depth) {
  const std::vector<ods::Placement> kept = ods::read_placements(item.path);
  if (kept.empty()) return;
  try {
    give_stage(item, depth);
  } catch (const UsageError& error) {
    return warn(fmt::format("'{}' is left out: {}", ods::placements_path(item.path), error.what()));
  }
  for (const ods::Placement& placement : kept) {
    try {
      item.objects.push_back(open_placed(placement));
    } catch (const ods::Error& error) {
      if (error.kind() != ods::ErrorKind::kInput) throw;
      warn(fmt::format("'{}': an object is left out: {}", ods::placements_path(item.path), error.what()));
    }
  }
}

}  // namespace

void add_objects(const ObjectOptions& options, const DepthInput& depth, std::vector<ViewItem>& items) {
  const std::vector<PlacedObject> placed = placed_objects(options);
  const auto check_depth = [&] {
    if (depth.path.empty() || std::ranges::any_of(items, [](const ViewItem& item) { return item.stage != nullptr; }))
      return;
    throw UsageError("--depth is for objects in a picture: add --with FILE");
  };
  if (placed.empty()) {
    for (ViewItem& item : items) {
      if (shows_layers(item) || shows_picture(item)) add_kept(item, depth);
    }
    return check_depth();
  }
  if (placed.size() > ods::kMaxPlacements) {
    throw UsageError(fmt::format("--with: at most {} objects", ods::kMaxPlacements));
  }
  const bool has_layers = std::ranges::any_of(items, shows_layers);
  const auto holds = has_layers ? shows_layers : shows_picture;
  if (std::ranges::count_if(items, holds) != 1) {
    throw UsageError(
        "--with puts objects into one layered scene, which ods layers makes, or into one picture with depth: "
        "ods view scene.layers.glb --with FILE");
  }
  ViewItem& item = *std::ranges::find_if(items, holds);
  give_stage(item, depth);
  check_depth();
  const ods::vec3 ahead = item.stage ? item.stage->ahead : item.ahead;
  for (const PlacedObject& object : placed) {
    item.objects.push_back(open_placed({object.file, object.at.value_or(ahead), object.turn}));
  }
}
