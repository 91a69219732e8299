// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/error.h"
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

void add_kept(ViewItem& item) {
  for (const ods::Placement& placement : ods::read_placements(item.path)) {
    try {
      item.objects.push_back(open_placed(placement));
    } catch (const ods::Error& error) {
      if (error.kind() != ods::ErrorKind::kInput) throw;
      warn(fmt::format("'{}': an object is left out: {}", ods::placements_path(item.path), error.what()));
    }
  }
}

}  // namespace

void add_objects(const ObjectOptions& options, std::vector<ViewItem>& items) {
  const std::vector<PlacedObject> placed = placed_objects(options);
  if (placed.empty()) {
    for (ViewItem& item : items) {
      if (shows_layers(item)) add_kept(item);
    }
    return;
  }
  if (placed.size() > ods::kMaxPlacements) {
    throw UsageError(fmt::format("--with: at most {} objects", ods::kMaxPlacements));
  }
  if (std::ranges::count_if(items, shows_layers) != 1) {
    throw UsageError(
        "--with puts objects into one layered scene, which ods layers makes: ods view scene.layers.glb --with FILE");
  }
  ViewItem& item = *std::ranges::find_if(items, shows_layers);
  for (const PlacedObject& object : placed) {
    item.objects.push_back(open_placed({object.file, object.at.value_or(item.ahead), object.turn}));
  }
}
