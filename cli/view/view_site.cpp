// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/view_site.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "cli/options/layout_options.h"
#include "cli/options/projection_options.h"
#include "ods/camera/file_names.h"
#include "ods/stage/exposure.h"
#include "ods/view/bundle.h"
#include "ods/view/page.h"

using ods::ViewItem, ods::StoredPicture;

namespace {

// Returns a number of the query, or nullopt if it is absent.
std::optional<float> number_of(const WebRequest& request, const std::string& name, float low, float high) {
  const std::string text = value_of(request, name);
  if (text.empty()) return {};
  float number = 0.0f;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size() || !(number >= low && number <= high)) {
    throw UsageError(fmt::format("{} must be {:g} to {:g}", name, low, high));
  }
  return number;
}

ods::EyeOptions read_eye_options(const WebRequest& request) {
  ods::EyeOptions options;
  options.exposure = number_of(request, "exposure", -ods::kMaxStops, ods::kMaxStops).value_or(0.0f);
  options.max_width = static_cast<int>(number_of(request, "width", 1.0f, 32768.0f).value_or(0.0f));
  options.tone = ods::find_in(ods::kToneCurveTable, value_of(request, "tone")).value_or(options.tone);
  return options;
}

// The paths of its files, without links; empty if there is none.
std::vector<std::string> files_behind(const ViewItem& item) {
  const auto behind = [](const std::string& path) {
    std::error_code fault;
    return std::filesystem::canonical(path, fault).native();
  };
  if (!item.fallback.empty()) return {behind(item.path), behind(item.fallback)};
  std::vector<std::string> files;
  for (const std::string& file : ods::files_of(item.path)) files.push_back(behind(file));
  return files;
}

// item/3/left.jpg -> 3; nothing for any other form.
std::optional<size_t> item_number(const std::string& path) {
  size_t number = 0;
  constexpr std::string_view kStart = "item/";
  if (!path.starts_with(kStart)) return {};
  const auto [end, fault] = std::from_chars(path.data() + kStart.size(), path.data() + path.size(), number);
  if (fault != std::errc() || end == path.data() + path.size() || *end != '/') return {};
  return number;
}

}  // namespace

ViewSite::ViewSite(std::vector<ViewItem> items, const std::optional<SceneSource>& scene,
                   const std::optional<ods::Tour>& tour)
    : tour_(tour),
      host_(scene ? ods::PageHost::kStudio : ods::PageHost::kView),
      script_(ods::bundle("main.js", host_)) {
  for (const ViewItem& item : items) add(item);
  if (!scene) return;
  studio_ =
      std::make_unique<Studio>(*scene, [this](const std::string& path) { return add(ods::open_view_item(path)); });
}

// The key of ViewSite::picture_.
static std::string opened_name(const ViewItem& item, const std::string& layout, const std::string& projection) {
  return fmt::format("{}\n{}\n{}", item.path, layout, projection);
}

size_t ViewSite::add(const ViewItem& item) {
  const std::lock_guard<std::mutex> lock(of_items_);
  items_.push_back(item);
  files_.push_back(files_behind(item));
  StoredPicture& picture = items_.back().picture;
  if (!picture.memory) return items_.size() - 1;
  if (!picture_) picture_ = std::make_shared<StoredPicture>(picture), opened_ = opened_name(item, "", "");
  for (ods::StoredEye& eye : picture.eyes) {
    for (ods::LayerPixels& layer : eye.layers) layer.first = nullptr;
  }
  picture.memory = nullptr;
  return items_.size() - 1;
}

std::optional<ViewItem> ViewSite::item_at(size_t number) const {
  const std::lock_guard<std::mutex> lock(of_items_);
  if (number >= items_.size() || files_behind(items_[number]) != files_[number]) return {};
  ViewItem item = items_[number];
  if (item.has_own_file) item.path = files_[number][0];
  if (!item.fallback.empty()) item.fallback = files_[number][1];
  return item;
}

std::shared_ptr<const StoredPicture> ViewSite::open(const ViewItem& item, const WebRequest& request) {
  const std::string layout = value_of(request, "layout"), projection = value_of(request, "projection");
  const std::string name = opened_name(item, layout, projection);
  if (opened_ == name) return picture_;
  ods::OpenOptions options;
  options.color_only = true;
  options.format = item.known;
  if (layout == "mono") options.format.one_eye = true;
  if (!layout.empty() && layout != "mono") options.format.layout = layout_by_name("layout", layout);
  if (!projection.empty() && projection != "own") {
    options.format.projection = projection_by_name("projection", projection);
  }
  picture_ = nullptr;  // never two in memory
  opened_.clear();
  picture_ = std::make_shared<StoredPicture>(ods::open_picture(item.path, options));
  opened_ = name;
  return picture_;
}

std::string ViewSite::kept_jpeg(const std::string& path, const ViewItem& item, std::string (*make)(const ViewItem&)) {
  std::error_code fault;  // of a pair, which does not have a file of this name: it changes with each ods view
  const auto written = std::filesystem::last_write_time(item.path, fault).time_since_epoch().count();
  const std::lock_guard<std::mutex> lock(of_small_);
  auto& [when, jpeg] = small_[path];
  if (jpeg.empty() || when != written) jpeg = make(item), when = written;
  return jpeg;
}

WebAnswer ViewSite::item(const std::string& path, const WebRequest& request) {
  const std::optional<size_t> number = item_number(path);
  const std::optional<ViewItem> found = number ? item_at(*number) : std::nullopt;
  if (!found) return nothing_there();
  const ViewItem& item = *found;
  if (item.has_own_file && path == item_files(item, *number)[0]) {
    return {.type = std::string(ods::media_type(path)), .file = item.path};
  }
  if (item.is_for_apple && path == system_file(item, *number)) {
    return {.type = std::string(ods::media_type(path)), .file = item.path};
  }
  if (!item.fallback.empty() && path == fallback_file(item, *number)) {
    return {.type = std::string(ods::media_type(path)), .file = item.fallback};
  }
  if (item.stage && path == ods::item_file(*number, ods::kDepthFile)) {
    return {.type = std::string(ods::media_type(path)), .body = item.stage->depth_png};
  }
  for (size_t i = 0; i < item.objects.size(); i++) {
    if (path != ods::object_file(*number, i)) continue;
    return {.type = std::string(ods::media_type(path)), .body = *item.objects[i].glb};
  }
  if (path == ods::item_file(*number, ods::kPreviewFile) && has_preview(item, true)) {
    return {.type = std::string(ods::media_type(path)), .body = kept_jpeg(path, item, ods::preview_jpeg)};
  }
  if (path == ods::item_file(*number, ods::kThumbnailFile) && has_stills(item)) {
    return {.type = std::string(ods::media_type(path)), .body = kept_jpeg(path, item, ods::thumbnail_jpeg)};
  }
  if (item.kind != ods::ItemKind::kPicture) return nothing_there();
  if (path.ends_with("/comfort.json") || path.ends_with("/comfort-left.jpg") || path.ends_with("/comfort-right.jpg")) {
    return comfort(item, path);
  }
  if (ods::has_light(item) && path == ods::item_file(*number, ods::kLightFile)) {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    return {.type = std::string(ods::media_type(path)), .body = light_png(*open(item, request))};
  }
  for (const int eye : {ods::kLeft, ods::kRight, ods::kMono}) {
    if (path != ods::item_file(*number, fmt::format("{}.jpg", ods::eye_name(eye)))) continue;
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    return {.type = std::string(ods::media_type(path)),
            .body = eye_jpeg(*open(item, request), eye, read_eye_options(request))};
  }
  return nothing_there();
}

WebAnswer ViewSite::comfort(const ViewItem& item, const std::string& path) {
  const std::lock_guard<std::mutex> lock(one_at_a_time_);
  if (judged_ != item.path) {
    judged_.clear();
    comfort_ = comfort_layer(item);
    judged_ = item.path;
  }
  if (path.ends_with(".json")) return {.type = "application/json", .body = comfort_.json};
  return {.type = "image/jpeg", .body = path.ends_with("left.jpg") ? comfort_.left : comfort_.right};
}

WebAnswer ViewSite::place_objects(const WebRequest& request) {
  const std::optional<size_t> number = item_number(fmt::format("item/{}/", value_of(request, "item")));
  if (!number || !item_at(*number)) return nothing_there();
  const std::lock_guard<std::mutex> lock(of_items_);
  ViewItem& item = items_[*number];
  if (item.objects.empty()) return nothing_there();
  std::vector<ods::Placement> placements;
  for (const ods::ViewObject& object : item.objects) placements.push_back(object.placement);
  ods::move_placements(request.body, placements);
  const std::string path = ods::write_placements(item.path, placements);
  for (size_t i = 0; i < placements.size(); i++) item.objects[i].placement = placements[i];
  return json_answer({{"file", std::filesystem::path(path).filename().string()}});
}

WebAnswer ViewSite::answer(const WebRequest& request) {
  if (studio_ && request.path.starts_with("studio/")) return studio_->answer(request);
  if (request.path == "share") return share_.answer(request);
  if (request.is_post && request.path == "objects") return place_objects(request);
  if (request.is_post) return nothing_there();
  if (request.path == "alive") {
    return {.type = "application/json", .body = fmt::format("{{\"pages\":{}}}", share_.pages())};
  }
  if (request.path == "view.json") {
    const ods::Json studio = studio_ ? studio_->description() : ods::Json();
    const std::lock_guard<std::mutex> lock(of_items_);
    return {.type = "application/json", .body = view_json(items_, true, studio, tour_ ? &*tour_ : nullptr)};
  }
  if (request.path.starts_with("item/")) return item(request.path, request);
  if (tour_ && tour_->plan && request.path == plan_file(*tour_->plan)) {
    return {.type = std::string(ods::media_type(request.path)), .file = tour_->plan->image};
  }
  const std::string name = request.path.empty() ? "index.html" : request.path;
  if (name == "main.js") return {.type = std::string(ods::media_type(name)), .body = script_};
  if (const std::string later = ods::bundle_later(name, host_); !later.empty()) {
    return {.type = std::string(ods::media_type(name)), .body = later};
  }
  const ods::PageFile* const file = ods::find_page_file(name);
  if (!file) return nothing_there();
  return {.type = std::string(ods::media_type(name)), .body = std::string(file->data)};
}
