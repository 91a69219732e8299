// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>

#include "ods/files/atomic_file.h"

namespace {

FinalMessage words_of = plain_final_message;
std::atomic<bool> said{false};
std::atomic<const char*> stop_message{nullptr};  // of the GentleStop, if there is one
std::atomic<int> stop_signal{0};                 // 0: no stop is requested
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
                  std::atomic<const char*>::is_always_lock_free,
              "a signal handler may touch them");

void say(const char* words) {
  const ssize_t ignored = write(STDERR_FILENO, words, std::strlen(words));
  static_cast<void>(ignored);
}

[[noreturn]] void end_by(int number) {
  ods::remove_unfinished_files();
  if (!said.exchange(true)) say(words_of(number));
  _exit(128 + number);
}

void on_signal(int number) {
  const char* const words = stop_message;
  if (words == nullptr || stop_signal.exchange(number) != 0) end_by(number);
  say(words);
}

}  // namespace

const char* plain_final_message(int) {
  return "ods: interrupted\n";
}

void end_on_interrupts(FinalMessage final_message) {
  words_of = final_message;
  signal(SIGXFSZ, SIG_IGN);  // a file size limit becomes an ordinary error, like a full disk
  const int kNumbers[] = {SIGHUP, SIGINT, SIGTERM};
  for (int number : kNumbers) {
    struct sigaction before = {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;  // started by nohup or as a shell's background job
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigaction(number, &action, nullptr);
  }
}

GentleStop::GentleStop(const char* words) {
  stop_signal = 0;
  stop_message = words;
}

GentleStop::~GentleStop() {
  stop_message = nullptr;
}

bool GentleStop::requested() const {
  return stop_signal != 0;
}

void GentleStop::end() const {
  std::fflush(stdout);
  end_by(stop_signal);
}
