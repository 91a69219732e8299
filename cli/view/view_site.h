// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The answers of ods view: the page's files, view.json, and the items by their numbers. A path that a browser sends is
// never opened.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cli/http/http_server.h"
#include "cli/view/comfort_layer.h"
#include "cli/view/share.h"
#include "cli/view/studio.h"
#include "ods/view/bundle.h"
#include "ods/view/view_item.h"

class ViewSite {
 public:
  // scene: for the studio; none: no scene is shown. tour: the items are its panoramas. Throws as Studio.
  ViewSite(std::vector<ods::ViewItem> items, const std::optional<SceneSource>& scene,
           const std::optional<ods::Tour>& tour = {});

  // Thread-safe. "" is the page; alive confirms that the server runs, and has the number of pages that share;
  // item/N/left.jpg takes exposure, tone, width, and a layout and projection chosen in the page; item/N/preview.jpg and
  // item/N/thumbnail.jpg; item/N/comfort.json, comfort-left.jpg and comfort-right.jpg are a ComfortLayer;
  // item/N/object-K.glb is an object, and a POST to objects?item=N moves the objects (docs/view.md); plan.* is
  // the plan of a tour. Throws UsageError for an invalid query.
  WebAnswer answer(const WebRequest& request);

  // The studio, for studio/drop; null if there is none.
  const Studio* studio() const { return studio_.get(); }

 private:
  WebAnswer item(const std::string& path, const WebRequest& request);
  // Moves the objects of a layered scene, and keeps their places beside its file.
  WebAnswer place_objects(const WebRequest& request);
  WebAnswer comfort(const ods::ViewItem& item, const std::string& path);
  // A preview or a thumbnail, made when it is first asked for.
  std::string kept_jpeg(const std::string& path, const ods::ViewItem& item, std::string (*make)(const ods::ViewItem&));
  // The picture of the latest item requested: both eyes are requested, one after the other.
  std::shared_ptr<const ods::StoredPicture> open(const ods::ViewItem& item, const WebRequest& request);

  size_t add(const ods::ViewItem& item);
  // Returns nullopt if its files have changed since it was opened.
  std::optional<ods::ViewItem> item_at(size_t number) const;

  std::optional<ods::Tour> tour_;
  mutable std::mutex of_items_;  // a rendering of the studio becomes an item
  std::vector<ods::ViewItem> items_;
  std::vector<std::vector<std::string>> files_;  // of each, behind all links
  std::unique_ptr<Studio> studio_;
  ods::PageHost host_;
  std::string script_;  // the page's
  Share share_;
  std::mutex of_small_;  // they are made one at a time, beside the others
  std::map<std::string, std::pair<std::filesystem::file_time_type::rep, std::string>>
      small_;                 // and when the file was written
  std::mutex one_at_a_time_;  // each uses all processors, and a picture's memory
  std::string opened_;
  std::shared_ptr<const ods::StoredPicture> picture_;
  std::string judged_;  // the path of the picture whose comfort this is
  ComfortLayer comfort_;
};
