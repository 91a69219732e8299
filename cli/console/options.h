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

#include "cli/console/console.h"
#include "cli/console/manual.h"
#include "cli/console/value_kind.h"
#include "ods/base/names.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

// One argument of a command line as parsed by parse().
struct GivenWord {
  std::string name;     // "-o", "--width"; empty: an argument
  std::string value;    // empty: a flag
  ValueKind kind = "";  // as the option was added
};

// Thrown by Options::parse().
struct HelpRequest {
  std::string text;  // help, a man page or a part of a completion script, as requested
};

class Options {
 public:
  // words: the arguments that follow the command's name.
  Options(std::string command, std::vector<std::string> words);
  ~Options();

  // The text of help: sentences, and lines of examples, which it prints first.
  void describe(const std::string& summary, const std::string& examples);

  // Starts a group: options added from here on are under this heading in help.
  void group(const std::string& heading);

  // Positional arguments, in order.
  void argument(const ValueKind& kind, std::string& value, const std::string& text);
  void optional_argument(const ValueKind& kind, std::string& value, const std::string& text);
  void arguments(const ValueKind& kind, std::vector<std::string>& values, const std::string& text);
  void flag(const std::string& name, bool& value, const std::string& text);
  void text(const std::string& name, const ValueKind& kind, std::string& value, const std::string& text);
  // An option that may be given several times; collects all values.
  void texts(const std::string& name, const ValueKind& kind, std::vector<std::string>& values, const std::string& text);
  void number(const std::string& name, int& value, int low, int high, const std::string& text);
  // fallback: the default, for help; empty: none is shown.
  void number(const std::string& name, std::optional<int>& value, int low, int high, const std::string& text,
              const std::string& fallback = "");
  void number(const std::string& name, float& value, float low, float high, const std::string& text);
  void number(const std::string& name, std::optional<float>& value, float low, float high, const std::string& text,
              const std::string& fallback = "");
  void number(const std::string& name, uint32_t& value, const std::string& text);

  // One member of a closed set, by name.
  template <class Row, size_t kCount>
  void choice(const std::string& name, ods::MemberOf<Row[kCount]>& value, const Row (&table)[kCount],
              const std::string& text) {
    choice(
        name, ods::names_of(table), std::string(ods::name_in(table, value)),
        [&value, &table](size_t i) { value = table[i].member; }, text);
  }

  // A choice by its index in the list of names.
  void choice(const std::string& name, const std::vector<std::string>& names, const std::string& fallback,
              const std::function<void(size_t)>& set, const std::string& text);

  // One member, or none.
  template <class Row, size_t kCount>
  void choice(const std::string& name, std::optional<ods::MemberOf<Row[kCount]>>& value, const Row (&table)[kCount],
              const std::string& text, const std::string& fallback = "") {
    choice(
        name, ods::names_of(table), fallback, [&value, &table](size_t i) { value = table[i].member; }, text);
  }

  // Passes the value to `set`, which throws UsageError if it is invalid.
  void custom(const std::string& name, const ValueKind& kind, const std::string& fallback,
              const std::function<void(const std::string&)>& set, const std::string& text);

  // The values that shell completion offers for this option or argument, which was added before.
  void offer(const std::string& name, const std::vector<std::string>& values);

  // Applies this option immediately during parsing, before other options are validated.
  void at_once(const std::string& name);

  // Throws UsageError, "NAME why", if one of these options was given.
  void refuse(const std::vector<std::string>& names, const std::string& why) const;

  // Throws UsageError, "NAME why", if any option was given but these. Arguments are not looked at.
  void refuse_others(const std::vector<std::string>& names, const std::string& why) const;

  // Returns the options and arguments given, in the order in which they were added, arguments first: the same command
  // line without repetitions.
  std::vector<GivenWord> given_words() const;

  // Removes "--" and the arguments after it from the words, and returns those arguments.
  std::vector<std::string> take_rest();

  // Sets the variables. Throws UsageError, and HelpRequest if one is anywhere before "--", whatever else is on the
  // line.
  void parse();

  // Set by the options that add_console_options() and add_progress_options() add.
  Console& console() { return console_; }
  const std::vector<std::string>& words() const { return words_; }

 private:
  void add_argument(const ValueKind& kind, const std::string& usage, const std::string& text);
  ManualEntry& add_option(const std::string& name, const ValueKind& kind, const std::string& text);
  std::string describe_extras() const;

  std::vector<std::string> words_;
  std::unique_ptr<CLI::App> app_;
  std::map<const CLI::Option*, ValueKind> kinds_;  // not of flags
  Manual manual_;
  Console console_;
};

// Adds --quiet and --no-color, which every command has, under their own heading.
void add_console_options(Options& options);

// "1.5" or "1,0.5,2": comma-separated numbers, including NaN and infinity; empty if the text is anything else.
std::vector<float> parse_numbers(const std::string& text);
