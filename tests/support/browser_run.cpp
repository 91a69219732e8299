// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/browser_run.h"

#include <fmt/format.h>

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "ods/files/atomic_file.h"
#include "ods/image/compare.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/picture_rows.h"
#include "tests/support/places.h"

namespace ods {

std::string run_in_browser(const BrowserRun& run) {
  std::mutex mutex;
  std::condition_variable is_done;
  std::string end;
  WebOptions options;
  options.secret = "secret";
  options.max_body = size_t{16} << 20;
  HttpServer server(options, [&](const WebRequest& request) -> WebAnswer {
    if (request.path != "done") return run.answer(request);
    const std::lock_guard lock(mutex);
    end = request.is_post ? request.body : value_of(request, "text");
    is_done.notify_all();
    return {};
  });
  std::thread thread([&server] { server.run(); });
  {
    std::unique_lock lock(mutex);
    const std::string address = fmt::format("http://127.0.0.1:{}/secret/", server.port());
    const Browser running(run.browser, run.home,
                          run.page.starts_with("file:") ? run.page + "?" + address : address + run.page);
    if (run.started) run.started(running.pid());
    is_done.wait_for(lock, run.patience, [&end] { return !end.empty(); });
    if (run.ends) run.ends(running.pid());
  }
  server.stop();
  thread.join();
  return end.empty() ? "the browser did not finish" : end;
}

std::string run_harness(const Harness& harness) {
  constexpr std::string_view kResult = "result/";
  const auto answer = [&](const WebRequest& request) -> WebAnswer {
    const std::string& name = request.path;
    if (request.is_post && name.starts_with(kResult)) {
      write_file(harness.folder + "/" + name.substr(kResult.size()), request.body);
      return {};
    }
    if (request.is_post) return harness.site(request);
    const std::string type(media_type(name));
    if (name == "jobs.json") return {.type = type, .body = harness.jobs};
    if (name == "iwer.module.js") return {.type = type, .file = std::getenv("ODS_IWER")};
    const std::string own = source_folder() + "/tests/web/" + name;
    return std::filesystem::is_regular_file(own) ? WebAnswer{.type = type, .file = own} : harness.site(request);
  };
  return run_in_browser({harness.browser, harness.folder + "/home", "harness.html", answer, harness.patience});
}

Image part_of_sent(const std::string& path, int column, Extent size) {
  OpenOptions options;
  options.format.one_eye = true;
  const StoredPicture picture = open_picture(path, options);
  Image image(size.width, size.height, 3);
  for (int y = 0; y < size.height; y++) {
    for (int x = 0; x < size.width; x++) {
      for (int c = 0; c < 3; c++) {
        image.at(x, y)[c] = value_at(picture.eyes[0].layers[0], x + column, y, static_cast<size_t>(c));
      }
    }
  }
  return image;
}

double likeness(const Image& a, const Image& b) {
  return compare_eyes({a}, {b}).whole.psnr;
}

}  // namespace ods
