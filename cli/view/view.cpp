// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods view: shows pictures and videos in the browser and in the headset.
#include <fmt/format.h>

#include <cstdio>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/interrupt.h"
#include "cli/console/print.h"
#include "cli/http/certificate.h"
#include "cli/view/desktop.h"
#include "cli/view/export_site.h"
#include "cli/view/qr_code.h"
#include "cli/view/view_job.h"
#include "cli/view/view_site.h"

namespace {

constexpr int kUsualPort = 8360;

const char* final_message(int) {
  return "ods: the viewer has ended\n";
}

// At the usual port, so that an open page finds the server again; if another program has it, at any.
std::unique_ptr<HttpServer> listen(WebOptions web, bool any_will_do, ViewSite& site) {
  const auto answer = [&site](const WebRequest& request) { return site.answer(request); };
  try {
    return std::make_unique<HttpServer>(web, answer);
  } catch (const UsageError&) {
    if (!any_will_do) throw;
    note(fmt::format("another program has port {}: using a random port. --port NUMBER chooses one", web.port));
    web.port = 0;
    return std::make_unique<HttpServer>(web, answer);
  }
}

void explain_network(const std::string& address, int port) {
  if (stderr_is_terminal() && !console.quiet) put_error(qr_code(address).c_str(), "");
  note(
      "open that address in the headset's browser; it warns, because ods made the certificate itself: choose Advanced, "
      "then Proceed. The page asks for a click to enter the headset");
  note(fmt::format(
      "everyone who has the address can see these files until you press Ctrl-C. By cable instead: end this, "
      "start it without --lan, and run adb reverse tcp:{} tcp:{}",
      port, port));
}

std::optional<SceneSource> scene_of(const ViewJob& job) {
  if (job.scene.empty()) return {};
  SceneSource source;
  source.name = job.scene;
  read_foreign(source);
  return source;
}

void serve(const ViewJob& job) {
  ViewSite site(open_items(job), scene_of(job), job.tour);
  const std::string folder = state_folder();
  WebOptions web;
  web.secret = job.lan && !job.keep_secret ? random_secret() : kept_secret(folder);
  if (site.studio()) web.upload = "studio/drop", web.upload_folder = site.studio()->drop_folder();
  if (job.browser && !job.lan) web.opener = random_secret();
  web.port = job.port.value_or(kUsualPort);
  std::string shown_host = web.hosts[0];
  if (job.lan) {
    const std::vector<std::string> addresses = network_addresses();
    if (addresses.empty()) throw ods::Error(ods::ErrorKind::kInput, "--lan: this machine is not on a network");
    if (folder.empty()) throw UsageError("--lan keeps its certificate in your home folder: set HOME");
    web.address = "0.0.0.0";
    web.hosts.insert(web.hosts.end(), addresses.begin(), addresses.end());
    const Certificate kept = keep_certificate(folder, web.hosts);
    web.certificate = kept.path, web.key = kept.key;
    shown_host = addresses[0];
  }
  const std::unique_ptr<HttpServer> server = listen(web, !job.port, site);
  const std::string address =
      fmt::format("{}://{}:{}/{}/", job.lan ? "https" : "http", shown_host, server->port(), web.secret);
  put_path(address);
  if (job.lan) explain_network(address, server->port());
  note("Ctrl-C ends it");
  if (job.browser && !job.lan) open_in_browser(fmt::format("http://{}:{}/{}", shown_host, server->port(), web.opener));
  end_on_interrupts(final_message);
  server->run();
}

void view(ViewJob job) {
  find_tour(job);
  find_scene(job);
  if (!job.scene.empty() && !job.objects.files.empty()) {
    throw UsageError("--with is for a layered scene, which ods layers makes of a scene, and for a picture with depth");
  }
  if (job.folder.empty()) return serve(job);
  announce_file(export_site(open_items(job), job.folder, job.texts, job.tour ? &*job.tour : nullptr));
}

}  // namespace

extern const Command kView =
    make_command<parse_view, view>("view", "show pictures and videos in the browser and in the headset");
