// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of one command: names bound to variables, whose values are the defaults that help prints. Hides CLI11.
// A value that is out of range, not a number or not in a list becomes a UsageError of one line.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/console/manual.h"
#include "ods/base/names.h"

namespace CLI {
class App;
}

class Options {
 public:
  // examples: lines that help prints first.
  Options(const std::string& command, const std::string& summary, const std::string& examples);
  ~Options();

  // Options added from here on stand under this heading in help.
  void group(const std::string& heading);

  // Words that are no options, in their order.
  void argument(const std::string& name, std::string& value, const std::string& text);
  // The options that were added before it are set by then, those after it are not yet.
  void argument(const std::string& name, const std::function<void(const std::string&)>& set, const std::string& text);
  void optional_argument(const std::string& name, std::string& value, const std::string& text);
  void arguments(const std::string& name, std::vector<std::string>& values, const std::string& text);
  void flag(const std::string& name, bool& value, const std::string& text);
  void text(const std::string& name, const std::string& unit, std::string& value, const std::string& text);
  // One that may be given several times: every word counts.
  void texts(const std::string& name, const std::string& unit, std::vector<std::string>& values,
             const std::string& text);
  void number(const std::string& name, int& value, int low, int high, const std::string& text);
  void number(const std::string& name, std::optional<int>& value, int low, int high, const std::string& text);
  void number(const std::string& name, float& value, float low, float high, const std::string& text);
  void number(const std::string& name, std::optional<float>& value, float low, float high, const std::string& text);
  void number(const std::string& name, uint32_t& value, const std::string& text);

  // One of a closed set, by its name in the set's table (ods/base/names.h).
  template <class Row, size_t kCount>
  void choice(const std::string& name, ods::MemberOf<Row[kCount]>& value, const Row (&table)[kCount],
              const std::string& text) {
    std::vector<std::string> names;
    for (const Row& row : table) names.emplace_back(row.name);
    choice(
        name, names, std::string(ods::name_in(table, value)), [&value, &table](size_t i) { value = table[i].member; },
        text);
  }

  // The same, by its place in the list of names.
  void choice(const std::string& name, const std::vector<std::string>& names, const std::string& fallback,
              const std::function<void(size_t)>& set, const std::string& text);

  // The same where nobody need choose.
  template <class Row, size_t kCount>
  void choice(const std::string& name, std::optional<ods::MemberOf<Row[kCount]>>& value, const Row (&table)[kCount],
              const std::string& text) {
    std::vector<std::string> names;
    for (const Row& row : table) names.emplace_back(row.name);
    choice(
        name, names, "", [&value, &table](size_t i) { value = table[i].member; }, text);
  }

  // Whatever set makes of the word; it throws UsageError.
  void custom(const std::string& name, const std::string& unit, const std::string& fallback,
              const std::function<void(const std::string&)>& set, const std::string& text);

  // What completion offers for this option or argument, which was added before.
  void offer(const std::string& name, const std::vector<std::string>& values);

  // Sets this option while the command line is read, before the values of others are judged.
  void at_once(const std::string& name);

  bool given(const std::string& name) const;

  // False when help was asked for: it has been printed, in the format of --help=FORMAT. Throws UsageError.
  bool parse(int argc, char** argv);

 private:
  void add_argument(const std::string& name, const std::string& usage, const std::string& text);
  ManualEntry& add_option(const std::string& name, const std::string& unit, const std::string& text);
  std::string describe_extras() const;

  std::unique_ptr<CLI::App> app_;
  Manual manual_;
};

// --quiet and --no-color, which every command has, under their heading.
void add_console_options(Options& options);

// "1.5" or "1,0.5,2": numbers between commas, NaN and infinity among them; empty when it is anything else.
std::vector<float> parse_numbers(const std::string& text);
