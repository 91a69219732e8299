// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio of ods view: a scene that is rendered while somebody looks, with every option of the camera a control.
// docs/view.md lists its requests.
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "cli/options/scene_source.h"
#include "cli/view/http_server.h"
#include "cli/view/render_process.h"
#include "ods/base/json_reader.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/studio/live_render.h"

class Studio {
 public:
  // Opens the scene, and notes what was assumed about it. add_item: is called with each picture that has been rendered,
  // and gives it a number. Throws as open_lit_scene().
  Studio(const SceneSource& source, std::function<size_t(const std::string& path)> add_item);
  ~Studio();

  // "studio" of view.json: the controls' defaults, their ranges and names.
  ods::Json description() const;

  // A request below studio/. Throws UsageError and Error(kInput) for what makes no sense, in a line for people.
  WebAnswer answer(const WebRequest& request);

 private:
  // What the page has set.
  struct Settings {
    ods::Sidecar sidecar;
    ods::LiveSettings live;
    std::string environment;
    std::string variant;
    int width = 4096;
    ods::LiveView look;
  };

  Settings read_settings(const std::string& text) const;
  static ods::Json settings_json(const Settings& settings);
  void open();
  std::vector<std::string> words(const std::string& output, const std::string& quality) const;
  WebAnswer set(const std::string& body);
  WebAnswer frame(const WebRequest& request);
  WebAnswer pick(const std::string& body);
  WebAnswer render(const std::string& body);
  WebAnswer job();
  WebAnswer save();
  WebAnswer status() const;
  WebAnswer drop(const WebRequest& request);
  void begin();

  mutable std::mutex mutex_;  // of all that follows
  SceneSource source_;
  Settings usual_, settings_;
  double duration_ = 0.0;
  std::shared_ptr<const ods::Scene> scene_;  // lives as long as whoever renders it
  std::shared_ptr<ods::LiveRender> live_;
  RenderProcess process_;
  std::string output_;          // of the process, until it is an item
  std::optional<size_t> item_;  // what it has rendered
  std::function<size_t(const std::string& path)> add_item_;
  std::string saved_;                          // the file of the camera; empty: not yet
  std::string dropped_scene_, dropped_light_;  // files of ours; empty: none
};
