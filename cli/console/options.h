// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of one command: names bound to variables, whose values are the defaults shown in help. Wraps CLI11. An
// invalid value becomes a UsageError of one line. A value that is a file is marked as one by its kind.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/console/manual.h"
#include "cli/console/value_kind.h"
#include "ods/base/names.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

// One word of a command line as parse() understood it.
struct GivenWord {
  std::string name;     // "-o", "--width"; empty: an argument
  std::string value;    // empty: a flag
  ValueKind kind = "";  // as the option was added
};

class Options {
 public:
  // examples: lines that help prints first.
  Options(const std::string& command, const std::string& summary, const std::string& examples);
  ~Options();

  // Starts a group: options added from here on are under this heading in help.
  void group(const std::string& heading);

  // Positional arguments, in order.
  void argument(const ValueKind& kind, std::string& value, const std::string& text);
  // The options that were added before it are set by then, those after it are not yet.
  void argument(const ValueKind& kind, const std::function<void(const std::string&)>& set, const std::string& text);
  void optional_argument(const ValueKind& kind, std::string& value, const std::string& text);
  void arguments(const ValueKind& kind, std::vector<std::string>& values, const std::string& text);
  void flag(const std::string& name, bool& value, const std::string& text);
  void text(const std::string& name, const ValueKind& kind, std::string& value, const std::string& text);
  // An option that may be given several times; collects all values.
  void texts(const std::string& name, const ValueKind& kind, std::vector<std::string>& values, const std::string& text);
  void number(const std::string& name, int& value, int low, int high, const std::string& text);
  void number(const std::string& name, std::optional<int>& value, int low, int high, const std::string& text);
  void number(const std::string& name, float& value, float low, float high, const std::string& text);
  void number(const std::string& name, std::optional<float>& value, float low, float high, const std::string& text);
  void number(const std::string& name, uint32_t& value, const std::string& text);

  // One member of a closed set, by name.
  template <class Row, size_t kCount>
  void choice(const std::string& name, ods::MemberOf<Row[kCount]>& value, const Row (&table)[kCount],
              const std::string& text) {
    choice(
        name, ods::names_of(table), std::string(ods::name_in(table, value)),
        [&value, &table](size_t i) { value = table[i].member; }, text);
  }

  // The same by index in the list of names.
  void choice(const std::string& name, const std::vector<std::string>& names, const std::string& fallback,
              const std::function<void(size_t)>& set, const std::string& text);

  // The same without a default.
  template <class Row, size_t kCount>
  void choice(const std::string& name, std::optional<ods::MemberOf<Row[kCount]>>& value, const Row (&table)[kCount],
              const std::string& text) {
    choice(
        name, ods::names_of(table), "", [&value, &table](size_t i) { value = table[i].member; }, text);
  }

  // Passes the word to `set`, which throws UsageError if it is invalid.
  void custom(const std::string& name, const ValueKind& kind, const std::string& fallback,
              const std::function<void(const std::string&)>& set, const std::string& text);

  // The values that shell completion offers for this option or argument, which was added before.
  void offer(const std::string& name, const std::vector<std::string>& values);

  // Applies this option immediately during parsing, before other options are validated.
  void at_once(const std::string& name);

  bool given(const std::string& name) const;

  // What was given, in the order in which it was added, arguments first: the same command line without repetitions.
  std::vector<GivenWord> given_words() const;

  // False if help was requested; it has been printed, in the format of --help=FORMAT. A request anywhere before "--"
  // wins over all else on the line: nothing is set, no file is opened. Throws UsageError.
  bool parse(int argc, char** argv);

 private:
  void add_argument(const ValueKind& kind, const std::string& usage, const std::string& text);
  ManualEntry& add_option(const std::string& name, const ValueKind& kind, const std::string& text);
  std::string describe_extras() const;

  std::unique_ptr<CLI::App> app_;
  std::map<const CLI::Option*, ValueKind> kinds_;  // not of flags
  Manual manual_;
};

// Adds --quiet and --no-color, which every command has, under their own heading.
void add_console_options(Options& options);

// "1.5" or "1,0.5,2": comma-separated numbers, including NaN and infinity; empty if the text is anything else.
std::vector<float> parse_numbers(const std::string& text);
