// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio of ods view: a scene that is rendered while the user looks, with a control for every option of the camera.
// docs/view.md lists its requests.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "cli/http/http_server.h"
#include "cli/options/scene_source.h"
#include "cli/view/render_process.h"
#include "ods/base/json_reader.h"
#include "ods/files/private_folder.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/studio/live_render.h"

WebAnswer json_answer(const ods::Json& json);

class Studio {
 public:
  // Opens the scene, and notes the assumptions about it. add_item: is called with each picture that has been rendered,
  // and gives it a number. Throws as open_lit_scene().
  Studio(const SceneSource& source, std::function<size_t(const std::string& path)> add_item);

  // "studio" of view.json: the controls' defaults, their ranges and names.
  ods::Json description() const;

  // The folder for files that are dropped onto the page, where studio/drop takes them.
  const std::string& drop_folder() const { return drops_.path(); }

  // Answers a request below studio/. Throws UsageError and Error(kInput) for invalid requests, with a line for people.
  WebAnswer answer(const WebRequest& request);

 private:
  // The settings of the page.
  struct Settings {
    ods::Sidecar sidecar;
    ods::LiveSettings live;
    std::string environment;
    ods::SkyOptions sky;  // for the environment "sky"
    float turn = 0.0f;    // of the environment, as LightOptions has it
    float strength = 1.0f;
    std::string variant;
    int width = 4096;
    ods::LiveView look;
  };

  static constexpr int kMaxMaps = 1000;  // of a session

  // A file that was dropped onto the page.
  struct Drop {
    std::string name;       // the name that the user knows
    std::string path;       // ours; empty: none
    std::string kept = {};  // the copy that Save camera wrote; empty: none
    const std::string& shown() const { return kept.empty() ? name : kept; }
  };

  Settings read_settings(const std::string& text) const;
  void read_camera(ods::JsonReader& reader, Settings& settings) const;
  ods::Json settings_json(const Settings& settings) const;
  ods::StereoCamera command_camera() const;
  static Settings suiting(const SceneSource& source, const ods::Scene& scene);
  void open(const SceneSource& source, bool is_new);
  std::string title() const;
  std::string environment_of(const Settings& settings, bool is_shown) const;
  std::string missing_files(const std::vector<std::string>& command) const;
  std::string without_paths(std::string text) const;
  std::vector<std::string> words(const std::string& maps, bool is_shown) const;
  std::string stem() const;
  WebAnswer route(const WebRequest& request);
  WebAnswer set(const std::string& body);
  WebAnswer comfort(const WebRequest& request);
  WebAnswer frame(const WebRequest& request);
  WebAnswer pick(const std::string& body);
  WebAnswer render(const std::string& body);
  WebAnswer job();
  WebAnswer save();
  WebAnswer status() const;
  WebAnswer drop(const WebRequest& request);
  static void discard(const Drop& drop);
  static void keep(Drop& drop);
  WebAnswer drop_camera(const std::string& name, const std::string& path);

  std::atomic<int> waiting_{0};  // for a frame
  mutable std::mutex mutex_;     // of all that follows
  SceneSource source_;
  Settings usual_, settings_;
  double duration_ = 0.0;
  std::shared_ptr<const ods::Scene> scene_;  // shared with the renderer
  std::shared_ptr<ods::LiveRender> live_;
  RenderProcess process_;
  std::optional<size_t> item_;  // its latest rendering
  std::function<size_t(const std::string& path)> add_item_;
  std::string saved_;  // the camera's files, without the ends of their names; empty: not saved yet
  ods::PrivateFolder drops_;
  int drop_count_ = 0;
  Drop dropped_scene_, dropped_light_;
  std::vector<std::shared_ptr<const ods::Image>> maps_;  // of cameras; the page has their numbers, not their pixels
};
