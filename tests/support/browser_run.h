// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs pages in a browser, and looks at what they send.
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
  std::vector<std::string> browser;  // the words that start it: chromium() of browser.h
  std::string home;                  // its folder
  std::string page;  // what it opens: of the server, or file://PAGE, whose query is the server's address
  Answer answer;     // all but `done`
  std::chrono::seconds patience;
  std::function<void(pid_t browser)> started = {};
  std::function<void(pid_t browser)> ends = {};  // it has said so, and still runs
};

// Serves a page to a browser until the page posts to `done`, or asks for it with a `text`, which is all that a page
// from disk may do. Returns what it said, or that it did not.
std::string run_in_browser(const BrowserRun& run);

// tests/web/harness.html, which gets jobs.json, the modules of tests/web, and the emulated headset that ODS_IWER names.
struct Harness {
  std::vector<std::string> browser;
  std::string folder;  // the browser's home is in it, and what the page posts to result/NAME becomes NAME there
  std::string jobs;    // JSON
  Answer site;         // everything else
  std::chrono::seconds patience;
};
std::string run_harness(const Harness& harness);

// A part of a picture that a page has sent, from the column on: code values as 0..1.
Image part_of_sent(const std::string& path, int column, Extent size);

// PSNR, dB.
double likeness(const Image& a, const Image& b);

}  // namespace ods
