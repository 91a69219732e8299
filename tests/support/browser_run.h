// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs pages in a browser, and examines the data that they send.
#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "cli/http/http_server.h"
#include "ods/base/extent.h"
#include "ods/image/image.h"

namespace ods {

using Answer = std::function<WebAnswer(const WebRequest& request)>;  // called from several threads

struct BrowserRun {
  std::vector<std::string> browser;  // the command line that starts it: chromium() of browser.h
  std::string home;                  // its folder
  std::string page;  // the page to open: of the server, or file://PAGE, whose query is the server's address
  Answer answer;     // for all requests but `done`
  std::chrono::seconds patience;
  std::function<void(pid_t browser)> started = {};
  std::function<void(pid_t browser)> ends = {};  // called when it has reported the end, and still runs
};

// Serves a page to a browser until the page posts to `done`, or requests it with a `text`, which is the only way for a
// page from disk. Returns its text, or an error if it did not report.
std::string run_in_browser(const BrowserRun& run);

// tests/web/harness.html, which gets jobs.json, the modules of tests/web, and the emulated headset that ODS_IWER names.
struct Harness {
  std::vector<std::string> browser;
  std::string folder;  // contains the browser's home; data that the page posts to result/NAME becomes NAME in it
  std::string jobs;    // JSON
  Answer site;         // all other requests
  std::chrono::seconds patience;
};
std::string run_harness(const Harness& harness);

// A part of a picture that a page has sent, starting at a column: code values as 0..1.
Image part_of_sent(const std::string& path, int column, Extent size);

// PSNR, dB.
double likeness(const Image& a, const Image& b);

}  // namespace ods
