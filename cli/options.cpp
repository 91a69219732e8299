// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "cli/console.h"
#include "cli/suggest.h"

namespace {

// The whole word as a number. Nothing for anything else, NaN and infinity included.
template <class T>
std::optional<T> parse_number(std::string_view word) {
  T value{};
  auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(static_cast<double>(value))) return {};
  return value;
}

template <class T>
T number_between(const std::string& name, const std::string& word, T low, T high) {
  std::optional<T> value = parse_number<T>(word);
  if (!value || *value < low || *value > high) {
    throw UsageError(fmt::format("{} is a {}number from {} to {}, not '{}'", name, std::is_integral_v<T> ? "whole " : "",
                                 low, high, word));
  }
  return *value;
}

}  // namespace

std::vector<float> parse_numbers(const std::string& text) {
  std::vector<float> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    size_t end = std::min(text.find(',', begin), text.size());
    std::optional<float> number = parse_number<float>(std::string_view(text).substr(begin, end - begin));
    if (!number) return {};
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

Options::Options(const std::string& command, const std::string& summary, const std::string& examples)
    : app_(std::make_unique<CLI::App>(summary + "\n\nExamples:\n" + examples, "ods " + command)) {
  app_->set_help_flag("-h,--help", "this text");
  app_->get_formatter()->column_width(36);
  app_->get_formatter()->label("OPTIONS", "[OPTIONS]");
}

Options::~Options() = default;

void Options::custom(const std::string& name, const std::string& unit, const std::string& fallback,
                     const std::function<void(const std::string&)>& set, const std::string& text) {
  std::string with_default = fallback.empty() ? text : text + " [" + fallback + "]";
  // The last one wins, so that a script can append to a command line.
  app_->add_option_function<std::string>(name, set, with_default)
      ->type_name(unit)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
      ->group(group_);
}

void Options::argument(const std::string& name, std::string& value, const std::string& text) {
  app_->add_option(name, value, text)->required()->type_name("");
}

void Options::flag(const std::string& name, bool& value, const std::string& text) {
  app_->add_flag(name, value, text)->group(group_);
}

void Options::text(const std::string& name, const std::string& unit, std::string& value, const std::string& text) {
  custom(name, unit, value, [&value](const std::string& word) { value = word; }, text);
}

void Options::number(const std::string& name, int& value, int low, int high, const std::string& text) {
  auto set = [=, &value](const std::string& word) { value = number_between(name, word, low, high); };
  custom(name, "N", fmt::format("{}", value), set, text);
}

void Options::number(const std::string& name, uint32_t& value, const std::string& text) {
  auto set = [=, &value](const std::string& word) { value = number_between(name, word, 0u, UINT32_MAX); };
  custom(name, "N", fmt::format("{}", value), set, text);
}

void Options::number(const std::string& name, float& value, float low, float high, const std::string& text) {
  auto set = [=, &value](const std::string& word) { value = number_between(name, word, low, high); };
  custom(name, "X", fmt::format("{}", value), set, text);
}

void Options::number(const std::string& name, std::optional<float>& value, float low, float high,
                     const std::string& text) {
  auto set = [=, &value](const std::string& word) { value = number_between(name, word, low, high); };
  custom(name, "X", "", set, text);
}

void Options::choice(const std::string& name, const std::vector<std::string>& names, const std::string& fallback,
                     const std::function<void(size_t)>& set, const std::string& text) {
  auto pick = [=](const std::string& word) {
    auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      throw UsageError(fmt::format("{} is one of {}, not '{}'", name, fmt::join(names, ", "), word));
    }
    set(static_cast<size_t>(found - names.begin()));
  };
  custom(name, fmt::format("{}", fmt::join(names, "|")), fallback, pick, text);
}

bool Options::given(const std::string& name) const { return app_->count(name) > 0; }

std::string Options::explain_extras() const {
  std::string first = app_->remaining().front();
  std::vector<std::string> names;
  for (const CLI::Option* option : app_->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  if (first.starts_with("-")) return fmt::format("there is no option '{}'{}", first, did_you_mean(first, names));
  return fmt::format("'{}' is one argument too many", first);
}

bool Options::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    return true;
  } catch (const CLI::CallForHelp&) {
    std::fputs(app_->help().c_str(), stdout);
    return false;
  } catch (const CLI::ExtrasError&) {
    throw UsageError(explain_extras());
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
}
