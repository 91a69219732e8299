// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>

#include "ods/base/suggest.h"

namespace {

// Parses the whole text as a number.
template <class T>
std::optional<T> parse_number(std::string_view word) {
  T value{};
  auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

template <class T>
T number_between(const std::string& name, const std::string& word, T low, T high) {
  std::optional<T> value = parse_number<T>(word);
  if (!value || !(*value >= low && *value <= high)) {  // NaN too
    throw UsageError(fmt::format("{} is a {}number from {} to {}, not '{}'", name,
                                 std::is_integral_v<T> ? "whole " : "", low, high, word));
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

Options::Options(std::string command, std::vector<std::string> words)
    : words_(std::move(words)), app_(std::make_unique<CLI::App>("", "ods " + command)) {
  manual_.command = std::move(command);
  app_->set_help_flag();  // CLI11's runs after the options' callbacks
  app_->add_flag_callback("-h,--help", [] { throw CLI::CallForHelp(); })->trigger_on_parse();  // for -qh
}

void Options::describe(const std::string& summary, const std::string& examples) {
  manual_.summary = summary;
  manual_.examples = examples;
}

Options::~Options() = default;

void Options::group(const std::string& heading) {
  manual_.entries.push_back({ManualEntry::Kind::kHeading, heading});
}

void Options::add_argument(const ValueKind& kind, const std::string& usage, const std::string& text) {
  manual_.usage += usage + " ";
  manual_.entries.push_back({ManualEntry::Kind::kArgument, kind.unit, kind, text});
}

ManualEntry& Options::add_option(const std::string& name, const ValueKind& kind, const std::string& text) {
  return manual_.entries.emplace_back(ManualEntry{ManualEntry::Kind::kOption, name, kind, text});
}

void Options::offer(const std::string& name, const std::vector<std::string>& values) {
  for (ManualEntry& entry : manual_.entries) {
    if (entry.kind != ManualEntry::Kind::kHeading && entry.name == name) entry.values = values;
  }
}

void Options::custom(const std::string& name, const ValueKind& kind, const std::string& fallback,
                     const std::function<void(const std::string&)>& set, const std::string& text) {
  add_option(name, kind, fallback.empty() ? text : text + " [" + fallback + "]");
  // The last value wins, so that a script can append to a command line.
  CLI::Option* const option = app_->add_option_function<std::string>(name, set);
  option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  kinds_.emplace(option, kind);
}

void Options::argument(const ValueKind& kind, std::string& value, const std::string& text) {
  kinds_.emplace(app_->add_option(kind.unit, value)->required(), kind);
  add_argument(kind, kind.unit, text);
}

void Options::optional_argument(const ValueKind& kind, std::string& value, const std::string& text) {
  kinds_.emplace(app_->add_option(kind.unit, value), kind);
  add_argument(kind, fmt::format("[{}]", kind.unit), text);
}

void Options::arguments(const ValueKind& kind, std::vector<std::string>& values, const std::string& text) {
  kinds_.emplace(app_->add_option("words", values), kind);
  add_argument(kind, fmt::format("[{}]", kind.unit), text);
  manual_.entries.back().repeats = true;
}

void Options::flag(const std::string& name, bool& value, const std::string& text) {
  app_->add_flag(name, value);
  add_option(name, "", text);
}

void Options::text(const std::string& name, const ValueKind& kind, std::string& value, const std::string& text) {
  custom(
      name, kind, value,
      [=, &value](const std::string& word) {
        if (word.empty()) throw UsageError(name + " has an empty value");
        value = word;
      },
      text);
}

void Options::texts(const std::string& name, const ValueKind& kind, std::vector<std::string>& values,
                    const std::string& text) {
  add_option(name, kind, text + "; may be given several times").repeats = true;
  CLI::Option* const option = app_->add_option(name, values);
  kinds_.emplace(option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->expected(1), kind);
}

void Options::number(const std::string& name, int& value, int low, int high, const std::string& text) {
  auto set = [=, &value](const std::string& word) { value = number_between(name, word, low, high); };
  custom(name, "N", fmt::format("{}", value), set, text);
}

void Options::number(const std::string& name, std::optional<int>& value, int low, int high, const std::string& text,
                     const std::string& fallback) {
  auto set = [=, &value](const std::string& word) { value = number_between(name, word, low, high); };
  custom(name, "N", fallback, set, text);
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
                     const std::string& text, const std::string& fallback) {
  auto set = [=, &value](const std::string& word) { value = number_between(name, word, low, high); };
  custom(name, "X", fallback, set, text);
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
  offer(name, names);
}

void add_console_options(Options& options) {
  options.flag("-q,--quiet", options.console().quiet,
               "print only errors, and text that is the result; no notes, warnings or names of written files");
  options.flag("--no-color", options.console().no_color, "no colours, as with the environment variable NO_COLOR");
}

void Options::at_once(const std::string& name) {
  app_->get_option(name)->trigger_on_parse();
}

void Options::refuse(const std::vector<std::string>& names, const std::string& why) const {
  for (const std::string& name : names) {
    if (app_->count(name) > 0) throw UsageError(name + " " + why);
  }
}

void Options::refuse_others(const std::vector<std::string>& names, const std::string& why) const {
  for (const CLI::Option* option : app_->get_options()) {
    if (option->count() == 0 || option->get_positional()) continue;
    if (std::ranges::none_of(names, [&](const std::string& name) { return option->check_name(name); })) {
      throw UsageError(option->get_name() + " " + why);
    }
  }
}

std::vector<GivenWord> Options::given_words() const {
  std::vector<GivenWord> arguments, words;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->count() == 0) continue;
    const bool is_argument = option->get_positional();
    const auto& short_names = option->get_snames();
    std::string name;
    if (!is_argument) name = short_names.empty() ? "--" + option->get_lnames().front() : "-" + short_names.front();
    const auto kind = kinds_.find(option);
    std::vector<std::string> values = option->results();
    if (option->get_items_expected_max() == 0) values = {""};
    if (option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeLast) values = {values.back()};
    for (const std::string& value : values) {
      (is_argument ? arguments : words).push_back({name, value, kind == kinds_.end() ? "" : kind->second});
    }
  }
  arguments.insert(arguments.end(), words.begin(), words.end());
  return arguments;
}

std::string Options::describe_extras() const {
  std::string first = app_->remaining().front();
  std::vector<std::string> names;
  for (const CLI::Option* option : app_->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  if (first.starts_with("-")) return fmt::format("there is no option '{}'{}", first, ods::did_you_mean(first, names));
  return fmt::format("'{}' is an extra argument", first);
}

// Returns the format of help that the arguments request, if any. parse() looks for it first, because a fault of another
// argument would hide the help. A value "--help" must therefore be written --output=--help, or follow "--".
static std::optional<ManualFormat> requested_help(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "--") break;
    if (const auto format = manual_format(word)) return format;
    if (word.starts_with("--help")) {
      throw UsageError(fmt::format("there is no option '{}': give --help, or --help=man, bash or zsh", word));
    }
  }
  return {};
}

std::vector<std::string> Options::take_rest() {
  const auto end = std::ranges::find(words_, "--");
  if (end == words_.end()) return {};
  std::vector<std::string> rest(end + 1, words_.end());
  words_.erase(end, words_.end());
  return rest;
}

void Options::parse() {
  const auto help = [this](ManualFormat format) {
    manual_.usage += "[OPTION...]";
    return HelpRequest{write_manual(manual_, format)};
  };
  if (const auto format = requested_help(words_)) throw help(*format);
  try {
    app_->parse(std::vector<std::string>(words_.rbegin(), words_.rend()));  // CLI11 takes them from the back
  } catch (const CLI::CallForHelp&) {
    throw help(ManualFormat::kHelp);
  } catch (const CLI::ExtrasError&) {
    throw UsageError(describe_extras());
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
}
