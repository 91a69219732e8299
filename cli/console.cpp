// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "ods/base/error.h"

Console console;

bool stderr_is_terminal() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) && term && std::string_view(term) != "dumb";
}

void note(const std::string& text) {
  if (!console.quiet) std::fprintf(stderr, "ods: %s\n", text.c_str());
}

namespace {

int fail(ExitCode code, std::string text) {
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;  // a file's name may hold anything
  const char* no_color = std::getenv("NO_COLOR");
  bool color = stderr_is_terminal() && !console.no_color && !(no_color && *no_color);
  std::fprintf(stderr, "ods: %s %s\n", color ? "\x1b[1;31merror:\x1b[0m" : "error:", text.c_str());
  return code;
}

int fail(const ods::Error& error) {
  switch (error.kind()) {
    case ods::ErrorKind::kInput:
      return fail(kExitInput, error.what());
    case ods::ErrorKind::kOutput:
      return fail(kExitOutput, error.what());
    case ods::ErrorKind::kCancelled:
      break;
  }
  std::fputs("ods: interrupted, no file was written\n", stderr);
  return 128 + interrupt_signal();
}

}  // namespace

int run_command(const std::function<void()>& body) {
  try {
    body();
    // A full disk behind stdout shows only now.
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      return fail(kExitOutput, "standard output could not be written");
    return kExitOk;
  } catch (const UsageError& error) {
    return fail(kExitUsage, error.what());
  } catch (const ods::Error& error) {
    return fail(error);
  } catch (const std::bad_alloc&) {
    return fail(kExitRenderError, "not enough memory; a smaller --width needs less");
  } catch (const std::exception& error) {
    return fail(kExitRenderError, error.what());
  }
}
