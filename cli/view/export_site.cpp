// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/export_site.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/files/atomic_file.h"
#include "ods/files/file_input.h"
#include "ods/view/page.h"

using ods::ViewItem;

// Needs a server that renders.
static bool is_of_studio(std::string_view name) {
  return name.starts_with("studio") || name.starts_with("merge-curve");
}

static void copy_file(const std::string& from, const std::string& to) {
  const ods::FileInput file(from);
  ods::AtomicFile copy(to);
  file.copy(0, file.size(), copy);
  copy.commit();
}

static void write_eyes(const ViewItem& item, const std::vector<std::string>& files, const std::string& folder) {
  ods::OpenOptions options;
  options.format = item.known;
  options.color_only = true;
  const ods::StoredPicture picture = ods::open_picture(item.path, options);
  if (has_light(item)) {
    const std::string beside = std::filesystem::path(files[0]).parent_path().string();
    ods::write_file(folder + "/" + beside + "/light.png", light_png(picture));
  }
  for (size_t i = 0; i < files.size(); i++) {
    ods::write_file(folder + "/" + files[i], eye_jpeg(picture, picture.eyes[i].eye, {}));
  }
}

std::string export_site(const std::vector<ViewItem>& items, const std::string& folder) {
  for (const ods::PageFile& file : ods::page_files()) {
    if (is_of_studio(file.name)) continue;
    ods::write_file(folder + "/" + std::string(file.name), file.data);
  }
  for (size_t i = 0; i < items.size(); i++) {
    const std::vector<std::string> files = item_files(items[i], i);
    const std::string beside = folder + "/" + std::filesystem::path(files[0]).parent_path().string();
    if (has_preview(items[i], false)) ods::write_file(beside + "/preview.jpg", preview_jpeg(items[i]));
    ods::write_file(beside + "/thumbnail.jpg", thumbnail_jpeg(items[i]));
    items[i].has_own_file ? copy_file(items[i].path, folder + "/" + files[0]) : write_eyes(items[i], files, folder);
  }
  const std::string view = folder + "/view.json";
  ods::write_file(view, view_json(items, false, {}));
  return view;
}
