// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/layout_options.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"

using ods::Layout;

namespace {

// "top-bottom (over-under, ou, tb), bottom-top (under-over, bt), ..."
std::string layout_list() {
  std::string list;
  for (Layout layout : ods::kLayouts) {
    std::string aliases;
    for (const ods::LayoutAlias& alias : ods::layout_aliases()) {
      if (alias.layout == layout) aliases += fmt::format("{}{}", aliases.empty() ? " (" : ", ", alias.word);
    }
    list += fmt::format("{}{}{}{}", list.empty() ? "" : ", ", ods::layout_name(layout), aliases,
                        aliases.empty() ? "" : ")");
  }
  return list;
}

}  // namespace

Layout layout_by_name(const std::string& name, const std::string& word) {
  if (auto layout = ods::layout_of(word)) return *layout;
  if (word == "mono" && name == "--to-layout") throw UsageError("--to-layout is for two eyes: --mono makes one eye");
  throw UsageError(fmt::format("{}: there is no layout '{}'{} (--help lists them)", name, word,
                               ods::did_you_mean(word, ods::names_of(ods::kLayoutTable))));
}

void add_layout_option(Options& options, std::optional<Layout>& layout, const std::string& text,
                       const std::string& name, const std::string& fallback) {
  auto set = [&layout, name](const std::string& word) { layout = layout_by_name(name, word); };
  options.custom(name, "LAYOUT", fallback, set, name == "--layout" ? text + ": " + layout_list() : text);
  options.offer(name, ods::names_of(ods::kLayoutTable));
}

void add_input_layout_option(Options& options, std::optional<Layout>& layout, const std::string& text) {
  auto set = [&layout](const std::string& word) {
    layout = word == "mono" ? Layout::kSeparate : layout_by_name("--layout", word);
  };
  options.custom("--layout", "LAYOUT", "", set, text + ": mono, " + layout_list());
  std::vector<std::string> words = ods::names_of(ods::kLayoutTable);
  words.insert(words.begin(), "mono");
  options.offer("--layout", words);
}
