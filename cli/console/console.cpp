// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/console.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "cli/console/exit_code.h"
#include "cli/console/print.h"
#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/files/atomic_file.h"

Console console;

bool stderr_is_terminal() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) && term && std::string_view(term) != "dumb";
}

namespace {

void print_json(const nlohmann::ordered_json& line) {
  put_error("", ods::json_document(line) + "\n");
}

ExitCode fail(ExitCode code, const std::string& what) {
  const std::string text = with_options(what);
  if (console.json) {
    print_json({{"error", text}, {"exit_code", static_cast<int>(code)}});
    return code;
  }
  const char* no_color = std::getenv("NO_COLOR");
  bool color = stderr_is_terminal() && !console.no_color && !(no_color && *no_color);
  put_error(color ? "ods: \x1b[1;31merror:\x1b[0m " : "ods: error: ", ods::one_line(text) + "\n");
  return code;
}

// A whole error in both forms, made while there is memory.
struct PreparedError {
  std::string plain, json;
};

PreparedError prepare(const std::string& text) {
  const nlohmann::ordered_json json = {{"error", text}, {"exit_code", static_cast<int>(kExitFailure)}};
  return {fmt::format("ods: error: {}\n", text),
          json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"};
}

// The errors of a lack of memory or threads, and files that may be the reason: "'a.png', 'b.png'".
struct Shortages {
  PreparedError memory, threads;

  explicit Shortages(const std::string& inputs) {
    const std::string suffix = inputs.empty() ? "" : " for " + inputs;
    memory = prepare(fmt::format("not enough memory{}; a smaller scene or picture needs less", suffix));
    threads =
        prepare(fmt::format("cannot start a thread{}: the limit on memory or processes is reached; "
                            "--threads N starts fewer",
                            suffix));
  }
};

Shortages shortages("");

// Writes an error without allocating. Threads that run out together give one line.
ExitCode fail_prepared(const PreparedError& error) {
  static std::once_flag is_written;
  std::call_once(is_written, [&] {
    const std::string_view line = console.json ? error.json : error.plain;
    const ssize_t ignored = write(STDERR_FILENO, line.data(), line.size());
    static_cast<void>(ignored);
  });
  return kExitFailure;
}

// Some library functions promise not to throw but allocate or start threads anyway, some destructors among them. If
// that fails, the process ends here. Must not allocate.
[[noreturn]] void end_in_terminate() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    ods::remove_unfinished_files();
    _exit(fail_prepared(shortages.memory));
  } catch (const std::exception& error) {
    if (std::string_view(error.what()).starts_with("pthread_create")) {  // oneTBB
      ods::remove_unfinished_files();
      _exit(fail_prepared(shortages.threads));
    }
    put_error("ods: terminated: ", std::string(error.what()) + "\n");
  } catch (...) {
  }
  std::abort();
}

ExitCode exit_code(ods::ErrorKind kind) {
  switch (kind) {
    case ods::ErrorKind::kUsage:
      return kExitUsage;
    case ods::ErrorKind::kInput:
      return kExitInput;
    case ods::ErrorKind::kOutput:
      return kExitOutput;
    case ods::ErrorKind::kMemory:
    case ods::ErrorKind::kDevice:
    case ods::ErrorKind::kCancelled:  // cannot happen: interrupts end the process themselves
      return kExitFailure;
  }
  return kExitFailure;
}

}  // namespace

void name_inputs(const std::vector<std::string>& files) {
  constexpr size_t kMax = 3;  // more would hide the message
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(fmt::format("'{}'", ods::one_line(file)));
  if (names.size() > kMax) names.resize(kMax), names.emplace_back("...");
  shortages = Shortages(fmt::format("{}", fmt::join(names, ", ")));
}

std::string with_options(const std::string& text) {
  std::string result;
  size_t done = 0;
  for (size_t open = text.find('`'); open != std::string::npos; open = text.find('`', open + 1)) {
    const size_t close = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-", open + 1);
    if (close == std::string::npos || text[close] != '`' || close == open + 1) continue;
    result += text.substr(done, open - done) + "--" + text.substr(open + 1, close - open - 1);
    done = close + 1, open = close;
  }
  return result + text.substr(done);
}

static std::mutex said_mutex;
static std::optional<std::set<std::string>> said;  // absent: no SaidOnce

SaidOnce::SaidOnce() {
  const std::lock_guard lock(said_mutex);
  said.emplace();
}

SaidOnce::~SaidOnce() {
  const std::lock_guard lock(said_mutex);
  said.reset();
}

static bool is_said(const std::string& text) {
  const std::lock_guard lock(said_mutex);
  return said && !said->insert(text).second;
}

void note(const std::string& text) {
  if (console.quiet || is_said(text)) return;
  if (console.json) return print_json({{"note", with_options(text)}});
  put_error("ods: ", ods::one_line(with_options(text)) + "\n");
}

void warn(const std::string& text) {
  if (console.quiet || is_said(text)) return;
  if (console.json) return print_json({{"warning", with_options(text)}});
  put_error("ods: warning: ", ods::one_line(with_options(text)) + "\n");
}

void announce_file(const std::string& file) {
  if (!console.quiet) put_path(file);
}

ExitCode run_to_exit_code(const std::function<ExitCode()>& body) {
  std::set_terminate(end_in_terminate);
  try {
    const ExitCode code = body();
    // Writing stdout to a full disk fails only now.
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      return fail(kExitOutput, "standard output could not be written");
    return code;
  } catch (const ods::Error& error) {
    return fail(exit_code(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    return fail_prepared(shortages.memory);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) return fail(kExitFailure, error.what());
    return fail_prepared(shortages.threads);
  } catch (const std::exception& error) {
    return fail(kExitFailure, error.what());
  }
}
