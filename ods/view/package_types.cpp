// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The types of <stereo-360>, from the tables of the package's README: their first column has the name, the second the
// type in TypeScript, the third the meaning.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <vector>

#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/view/package.h"
#include "ods/view/page.h"

namespace ods {

namespace {

struct Row {
  std::string name, type, meaning, standard;
};

// Attributes that follow the look, and those with a property of their name.
constexpr std::string_view kLook[] = {"yaw", "pitch", "fov", "mode"};
constexpr std::string_view kReflected[] = {"src", "item", "layout", "projection", "fps", "poster"};

bool is_in(std::span<const std::string_view> names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::string plain(std::string cell) {
  cell = std::regex_replace(cell, std::regex(R"(^\s+|\s+$)"), "");
  return std::regex_replace(cell, std::regex(R"(\\\|)"), "|");
}

std::string code(const std::string& cell) {
  return std::regex_replace(cell, std::regex("`"), "");
}

// The rows of the table below a heading. A cell ends at a bar without a backslash.
std::vector<Row> table(const std::string& readme, const std::string& heading) {
  const size_t begin = readme.find("\n## " + heading + "\n");
  if (begin == std::string::npos) throw Error(ErrorKind::kInput, "the README has no section " + heading);
  std::istringstream lines(readme.substr(begin + 1, readme.find("\n## ", begin + 1) - begin));
  std::vector<Row> rows;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    const std::regex cell(R"(((?:[^|\\]|\\.)*)\|)");
    for (std::sregex_iterator each(line.begin() + 1, line.end(), cell), end; each != end; ++each) {
      cells.push_back(plain((*each)[1]));
    }
    cells.resize(4);
    rows.push_back({code(cells[0]), code(cells[1]), cells[2], cells[3]});
  }
  if (rows.empty()) throw Error(ErrorKind::kInput, "the README's section " + heading + " has no table");
  return rows;
}

// A type of names: 'left' | 'right'.
std::string union_of(const std::vector<std::string>& names) {
  return fmt::format("'{}'", fmt::join(names, "' | '"));
}

// The names in an array of objects of a page's module.
std::vector<std::string> names_in(const char* module, const std::string& array) {
  const std::string text(find_page_file(module)->data);
  const size_t begin = text.find("export const " + array + " = [");
  const std::string part = text.substr(begin, text.find("];\n", begin) - begin);
  const std::regex name(R"~("?name"?: ?["']([\w-]+)["'])~");
  std::vector<std::string> names;
  for (std::sregex_iterator each(part.begin(), part.end(), name), end; each != end; ++each) names.push_back((*each)[1]);
  return names;
}

std::string member(const Row& row) {
  const std::string name = row.name.find('-') == std::string::npos ? row.name : "'" + row.name + "'";
  return row.meaning.empty() ? name : fmt::format("/** {} */\n  {}", row.meaning, name);
}

std::string property(const Row& row) {
  if (is_in(kLook, row.name)) return fmt::format("  {}: {};\n", member(row), row.type);
  const std::string wide = row.type == "string" ? row.type : "string | " + row.type;
  return fmt::format("  get {0}(): string | null;\n  set {0}(value: {1} | null);\n", row.name, wide);
}

}  // namespace

std::string element_types(const std::string& readme) {
  std::string attributes, members, events;
  for (const Row& row : table(readme, "Attributes")) {
    attributes += fmt::format("  {}?: {};\n", member(row), row.type);
    if (is_in(kLook, row.name) || is_in(kReflected, row.name)) members += property(row);
  }
  for (Row row : table(readme, "Properties and methods")) {
    const bool is_fixed = row.type.starts_with("readonly ");
    const std::string type = is_fixed ? row.type.substr(9) : row.type;
    members += fmt::format("  /** {} */\n  {}{}: {};\n", row.meaning, is_fixed ? "readonly " : "", row.name, type);
  }
  for (const Row& row : table(readme, "Events")) {
    events += fmt::format("  {}: CustomEvent<{}>;\n", member(row), row.type);
  }
  return fmt::format(R"(// Made from the tables of README.md.
export type Layout = {};
export type Projection = {};
export type Mode = {};

export interface Look {{
  yaw: number;
  pitch: number;
  fov: number;
  mode: Mode;
}}

export interface Stereo360Attributes {{
{}}}

export interface Stereo360EventMap {{
{}}}

export class Stereo360 extends HTMLElement {{
  static readonly layouts: readonly Layout[];
  static readonly projections: readonly Projection[];
{}
  addEventListener<K extends keyof Stereo360EventMap>(type: K, listener: (this: Stereo360, event: Stereo360EventMap[K]) => void, options?: boolean | AddEventListenerOptions): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
}}

declare global {{
  interface HTMLElementTagNameMap {{
    'stereo-360': Stereo360;
  }}
  namespace JSX {{
    interface IntrinsicElements {{
      'stereo-360': Stereo360Attributes & {{ [name: string]: unknown }};
    }}
  }}
}}
)",
                     union_of(names_in("formats.js", "LAYOUTS")), union_of(names_in("formats.js", "PROJECTIONS")),
                     union_of(names_in("modes.js", "MODES")), attributes, events, members);
}

std::string element_manifest(const std::string& readme) {
  Json attributes = Json::array(), members = Json::array(), events = Json::array();
  for (const Row& row : table(readme, "Attributes")) {
    Json attribute = {{"name", row.name}, {"type", {{"text", row.type}}}, {"description", row.meaning}};
    if (!row.standard.empty()) attribute["default"] = code(row.standard);
    attributes.push_back(attribute);
    if (!is_in(kLook, row.name) && !is_in(kReflected, row.name)) continue;
    members.push_back({{"kind", "field"}, {"name", row.name}, {"attribute", row.name}, {"type", {{"text", row.type}}}});
  }
  for (const Row& row : table(readme, "Properties and methods")) {
    const bool is_method = row.type.find("=>") != std::string::npos;
    members.push_back({{"kind", is_method ? "method" : "field"}, {"name", row.name}, {"description", row.meaning}});
  }
  for (const Row& row : table(readme, "Events")) {
    const std::string type = fmt::format("CustomEvent<{}>", row.type);
    events.push_back({{"name", row.name}, {"type", {{"text", type}}}, {"description", row.meaning}});
  }
  const Json element = {{"kind", "class"},    {"customElement", true}, {"tagName", "stereo-360"}, {"name", "Stereo360"},
                        {"members", members}, {"events", events},      {"attributes", attributes}};
  const Json exported = {{"kind", "custom-element-definition"},
                         {"name", "stereo-360"},
                         {"declaration", {{"name", "Stereo360"}, {"module", "stereo-360.mjs"}}}};
  const Json module = {
      {"kind", "javascript-module"}, {"path", "stereo-360.mjs"}, {"declarations", {element}}, {"exports", {exported}}};
  return json_document({{"schemaVersion", "1.0.0"}, {"modules", {module}}}, 2) + "\n";
}

}  // namespace ods
