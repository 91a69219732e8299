// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio of ods view: a scene that is rendered while somebody looks, with every option of the camera a control.
// docs/view.md lists its requests.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "cli/options/scene_source.h"
#include "cli/view/http_server.h"
#include "cli/view/render_process.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/studio/live_render.h"

class Studio {
 public:
  // Opens the scene, and notes what was assumed about it. Throws as open_lit_scene().
  explicit Studio(const SceneSource& source);

  // "studio" of view.json: the controls' defaults, their ranges and names.
  std::string description() const;

  // A request below studio/. Throws UsageError and Error(kInput) for what makes no sense, in a line for people.
  WebAnswer answer(const WebRequest& request);

  // A picture that has been rendered since the last call; empty: none.
  std::string take_result();

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
  std::string settings_json(const Settings& settings) const;
  void open();
  std::vector<std::string> words(const std::string& output, const std::string& quality) const;
  WebAnswer set(const std::string& body);
  WebAnswer frame(const WebRequest& request);
  WebAnswer pick(const std::string& body);
  WebAnswer render(const std::string& body);
  WebAnswer job();
  WebAnswer save();

  mutable std::mutex mutex_;  // of all that follows
  SceneSource source_;
  Settings usual_, settings_;
  double duration_ = 0.0;
  std::shared_ptr<const ods::Scene> scene_;  // lives as long as whoever renders it
  std::shared_ptr<ods::LiveRender> live_;
  RenderProcess process_;
  std::string output_;  // of the process
  std::string last_;    // rendered
  std::string result_;  // likewise, until it is taken
};
