// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

using Kind = ManualEntry::Kind;

namespace {

constexpr const char* kTitle = "render, convert and check stereo 360 pictures and videos";

constexpr const char* kManualSummary =
    "ods renders omni-directional stereo (stereo 360 degree) pictures and videos of glTF "
    "scenes.";

constexpr const char* kManualExamples =
    "  ods render scene.glb -o picture.png        left eye on top, ready for a headset\n"
    "  ods render room -o room.png                a built-in scene\n"
    "  ods info scene.glb                         what is in the scene";

constexpr const char* kExplain =
    "ods COMMAND --help explains a command; ods --version prints the versions of ods and its libraries.";

struct ExitMeaning {
  const char* code;
  const char* meaning;
};

constexpr ExitMeaning kExitMeanings[] = {
    {"0", "done"},
    {"1", "anything else: not enough memory"},
    {"2", "the command line is wrong: a value, a conflict, a name that is unknown or not in the file"},
    {"3", "a file is absent, broken or not supported"},
    {"4", "a file could not be written"},
    {"5", "the input was judged and has a fault: ods lint found one, a limit of ods compare is exceeded"},
    {"130", "interrupted (Ctrl-C), 143 terminated (SIGTERM), 129 hung up (SIGHUP)"}};

const ManualEntry kHelpOption = {Kind::kOption, "-h,--help", "", "show this help"};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

// The options as completion lists them, --help too.
std::vector<ManualEntry> options_of(const Manual& manual) {
  std::vector<ManualEntry> options = {kHelpOption};
  for (const ManualEntry& entry : manual.entries) {
    if (entry.kind == Kind::kOption) options.push_back(entry);
  }
  return options;
}

bool is_file(const ManualEntry& entry) {
  return entry.value.use != PathUse::kNone && !entry.value.is_folder;
}

bool is_folder(const ManualEntry& entry) {
  return entry.value.use != PathUse::kNone && entry.value.is_folder;
}

// --- help ----------------------------------------------------------------------------------------------------------

// A line with this beginning and a text after it, wrapped to lines that begin at that column, for a terminal.
std::string wrapped(std::string line, size_t column, const std::string& text) {
  const size_t kLineWidth = 100;
  std::string rows;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (line.size() > column && line.size() + 1 + word.size() > kLineWidth) {
      rows += line + "\n";
      line.assign(column, ' ');
    }
    line += (line.size() > column ? " " : "") + word;
  }
  return rows + line + "\n";
}

// One row of help: the name, and beside it the text. An argument's name describes its value.
std::string help_row(const ManualEntry& entry) {
  const size_t kTextColumn = 30;
  const bool has_unit = entry.kind == Kind::kOption && !entry.value.unit.empty();
  std::string name = "  " + entry.name + (has_unit ? " " + entry.value.unit : "");
  const bool is_long = name.size() + 2 > kTextColumn;
  const std::string row = is_long ? name + "\n" : "";
  name.resize(is_long ? 0 : name.size());
  name.resize(kTextColumn, ' ');
  return row + wrapped(name, kTextColumn, entry.text);
}

std::string help(const Manual& manual) {
  std::string text = fmt::format("{}\nExamples:\n{}\n\nUsage: ods {} {}\n", wrapped("", 0, manual.summary),
                                 manual.examples, manual.command, manual.usage);
  for (const ManualEntry& entry : manual.entries) {
    text += entry.kind == Kind::kHeading ? fmt::format("\n{}:\n", entry.name) : help_row(entry);
  }
  return text;
}

std::string help(const std::vector<CommandSummary>& commands) {
  std::string text = fmt::format("{}\n\nExamples:\n{}\n\nCommands:\n", kManualSummary, kManualExamples);
  for (const CommandSummary& command : commands) text += fmt::format("  {:<10} {}\n", command.name, command.summary);
  text += fmt::format("\n{}\nExit codes:\n", kExplain);
  for (const ExitMeaning& exit : kExitMeanings) text += fmt::format("  {:<4} {}\n", exit.code, exit.meaning);
  return text;
}

// --- man page ------------------------------------------------------------------------------------------------------

// Text for troff: a hyphen is a minus that can be copied, and no line is taken for a request.
std::string troff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if ((out.empty() || out.back() == '\n') && (c == '.' || c == '\'')) out += "\\&";
    out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  }
  return out;
}

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

// Up to the end of the first sentence or a colon.
std::string first_words(const std::string& text) {
  return text.substr(0, std::min(text.find(":\n"), text.find('.')));
}

std::string man_start(const std::string& name, std::string line, const std::string& usage, const std::string& summary) {
  line[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(line[0])));
  return fmt::format(
      ".TH {} 1 \"\" \"ods {}\" \"Omnistereo\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}\n.SH DESCRIPTION\n{}\n",
      troff(capitals(name)), ODS_VERSION, troff(name), troff(line), usage, troff(summary));
}

std::string man_examples(const std::string& examples) {
  std::string text = ".SH EXAMPLES\n.EX\n";
  for (const std::string& line : split(examples, '\n'))
    text += troff(line.substr(std::min<size_t>(2, line.size()))) + "\n";
  return text + ".EE\n";
}

std::string man_exit_codes() {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : kExitMeanings) text += fmt::format(".TP\n{}\n{}\n", exit.code, troff(exit.meaning));
  return text;
}

std::string man_entry(const ManualEntry& entry) {
  if (entry.kind == Kind::kHeading) return fmt::format(".SS {}\n", troff(entry.name));
  std::string names;
  for (const std::string& name : split(entry.name, ',')) {
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", troff(name));
  }
  return fmt::format(".TP\n{}{}\n{}\n", names,
                     entry.value.unit.empty() ? "" : " \\fI" + troff(entry.value.unit) + "\\fR", troff(entry.text));
}

std::string man_page(const Manual& manual) {
  std::string text =
      man_start("ods-" + manual.command, first_words(manual.summary),
                fmt::format("\\fBods {}\\fR {}", troff(manual.command), troff(manual.usage)), manual.summary);
  text += ".SH OPTIONS\n";
  for (const ManualEntry& entry : manual.entries) text += man_entry(entry);
  return text + man_entry(kHelpOption) + man_examples(manual.examples) + man_exit_codes() +
         ".SH SEE ALSO\n.BR ods (1)\n";
}

std::string man_page(const std::vector<CommandSummary>& commands) {
  std::string text = man_start("ods", kTitle, "\\fBods\\fR \\fICOMMAND\\fR [OPTION...]", kManualSummary) + ".PP\n" +
                     troff(kExplain) + "\n.SH COMMANDS\n";
  for (const CommandSummary& command : commands) {
    text += fmt::format(".TP\n.BR ods\\-{} (1)\n{}\n", troff(command.name), troff(command.summary));
  }
  return text + man_examples(kManualExamples) + man_exit_codes();
}

// --- completion: bash ----------------------------------------------------------------------------------------------

std::string bash_start(const std::vector<CommandSummary>& commands) {
  std::string names;
  for (const CommandSummary& command : commands) names += command.name + " ";
  return fmt::format(
      "# Completion of ods for bash, printed by ods --help=bash.\n"
      "_ods() {{\n"
      "  local word=$2 before=$3 options= values=\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    COMPREPLY=($(compgen -W '{}--help --version' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n",
      names);
}

// The completion after an option: one of its values, a file, a folder, or anything; empty for a flag.
std::string bash_value(const ManualEntry& option) {
  if (option.value.unit.empty()) return "";
  if (!option.values.empty()) return fmt::format("values='{}'", fmt::join(option.values, " "));
  if (is_file(option)) return "return";
  return is_folder(option) ? "values=$(compgen -d -- \"$word\")" : "compopt +o default; return";
}

std::string bash_part(const Manual& manual) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> options_with;  // by their completion
  for (const ManualEntry& option : options_of(manual)) {
    for (const std::string& name : split(option.name, ',')) {
      names.push_back(name);
      options_with[bash_value(option)].push_back(name);
    }
  }
  options_with.erase("");
  std::string words, cases;
  for (const ManualEntry& entry : manual.entries) {
    if (entry.kind == Kind::kArgument) words += fmt::format("{}", fmt::join(entry.values, " "));
  }
  for (const auto& [value, options] : options_with) {
    cases += fmt::format("        {}) {} ;;\n", fmt::join(options, " | "), value);
  }
  return fmt::format("    {})\n      options='{}' values='{}'\n      case $before in\n{}      esac\n      ;;\n",
                     manual.command, fmt::join(names, " "), words, cases);
}

constexpr const char* kBashEnd =
    "  esac\n"
    "  [[ $word == -* ]] && values=$options\n"
    "  COMPREPLY=($(compgen -W \"$values\" -- \"$word\"))\n"
    "}\n"
    "complete -o default -F _ods ods\n";

// --- completion: zsh -----------------------------------------------------------------------------------------------

// Inside single quotes, brackets and fields that end with colons.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else if (c == '\n') {
      out += ' ';
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out;
}

std::string zsh_start(const std::vector<CommandSummary>& commands) {
  std::string text =
      "#compdef ods\n"
      "# Completion of ods for zsh, printed by ods --help=zsh.\n"
      "_ods() {\n"
      "  if (( CURRENT == 2 )); then\n"
      "    local -a commands=(\n";
  for (const CommandSummary& command : commands) {
    text += fmt::format("      '{}:{}'\n", command.name, zsh_text(command.summary));
  }
  return text +
         "    )\n"
         "    _describe command commands\n"
         "    return\n"
         "  fi\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $words[1] in\n";
}

// ":FILE:_files"
std::string zsh_value(const ManualEntry& entry, const std::string& name) {
  std::string action;
  if (!entry.values.empty()) {
    action = fmt::format("({})", fmt::join(entry.values, " "));
  } else if (is_folder(entry)) {
    action = "_files -/";
  } else if (is_file(entry)) {
    action = "_files";
  }
  if (entry.kind == Kind::kArgument && !entry.values.empty()) {
    action = fmt::format("{{ _alternative \"names:name:{}\" \"files:file:_files\" }}", action);
  }
  return fmt::format(":{}:{}", zsh_text(name), action);
}

std::string zsh_option(const ManualEntry& option) {
  const std::vector<std::string> names = split(option.name, ',');
  std::string row = "      ";
  if (option.repeats) {
    row += "'*'";
  } else if (names.size() > 1) {
    row += fmt::format("'({})'", fmt::join(names, " "));
  }
  row += names.size() > 1 ? fmt::format("{{{}}}", fmt::join(names, ",")) : names[0];
  row += fmt::format(
      "'[{}]{}'", zsh_text(option.text),
      option.value.unit.empty() ? "" : zsh_value(option, option.values.empty() ? option.value.unit : "value"));
  return row + " \\\n";
}

std::string zsh_part(const Manual& manual) {
  std::string text = fmt::format("    {})\n      _arguments -s \\\n", manual.command);
  for (const ManualEntry& option : options_of(manual)) text += zsh_option(option);
  for (const ManualEntry& entry : manual.entries) {
    if (entry.kind != Kind::kArgument) continue;
    text += fmt::format("      '{}{}' \\\n", entry.repeats ? "*" : "", zsh_value(entry, entry.name));
  }
  return text + "        && return\n      ;;\n";
}

constexpr const char* kZshEnd = "  esac\n}\n_ods \"$@\"\n";

}  // namespace

std::optional<ManualFormat> manual_format(std::string_view word) {
  if (word == "--help" || word == "-h") return ManualFormat::kHelp;
  if (word == "--help=man") return ManualFormat::kMan;
  if (word == "--help=bash") return ManualFormat::kBash;
  if (word == "--help=zsh") return ManualFormat::kZsh;
  return {};
}

std::string write_manual(const Manual& manual, ManualFormat format) {
  switch (format) {
    case ManualFormat::kHelp:
      return help(manual);
    case ManualFormat::kMan:
      return man_page(manual);
    case ManualFormat::kBash:
      return bash_part(manual);
    case ManualFormat::kZsh:
      return zsh_part(manual);
  }
  return "";
}

std::string write_overview(const std::vector<CommandSummary>& commands, ManualFormat format) {
  switch (format) {
    case ManualFormat::kHelp:
      return help(commands);
    case ManualFormat::kMan:
      return man_page(commands);
    case ManualFormat::kBash:
      return bash_start(commands);
    case ManualFormat::kZsh:
      return zsh_start(commands);
  }
  return "";
}

std::string end_of_overview(ManualFormat format) {
  return format == ManualFormat::kBash ? kBashEnd : format == ManualFormat::kZsh ? kZshEnd : "";
}
