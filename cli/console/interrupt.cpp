// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstring>

#include "ods/files/atomic_file.h"

namespace {

LastWords words_of = plain_last_words;
std::atomic<bool> said{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch it");

void on_signal(int number) {
  ods::remove_unfinished_files();
  const char* const words = words_of(number);
  const ssize_t ignored = said.exchange(true) ? 0 : write(STDERR_FILENO, words, std::strlen(words));
  static_cast<void>(ignored);
  _exit(128 + number);
}

}  // namespace

const char* plain_last_words(int) {
  return "ods: interrupted\n";
}

void end_on_interrupts(LastWords last_words) {
  words_of = last_words;
  signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error like a full disk
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
