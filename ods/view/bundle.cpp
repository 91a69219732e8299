// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <vector>

#include "ods/base/base64.h"
#include "ods/base/json_reader.h"
#include "ods/view/page.h"

namespace ods {

namespace {

// import { A, B as C } from './x.js';  and  import('./x.js')
const std::regex kImport(R"(import \{([^}]*)\} from '\./([\w.-]+)';)");
const std::regex kLazyImport(R"(import\('\./([\w.-]+)'\))");
const std::regex kExport(R"((^|\n)export ((?:async )?(?:class|function|const|let) )(\w+))");

std::vector<std::string> names_in(const std::string& text, const std::regex& pattern, size_t group) {
  std::vector<std::string> names;
  for (std::sregex_iterator each(text.begin(), text.end(), pattern), end; each != end; ++each) {
    names.push_back((*each)[group]);
  }
  return names;
}

// A module as a function that returns what it exports.
std::string wrapped(const std::string& name, const std::string& module) {
  const std::vector<std::string> exported = names_in(module, kExport, 3);
  const std::string text = std::regex_replace("\n" + module, kExport, "$1$2$3");
  std::string whole;
  auto rest = text.cbegin();
  for (std::sregex_iterator each(text.begin(), text.end(), kImport), end; each != end; ++each) {
    const std::string names = std::regex_replace((*each)[1].str(), std::regex(" as "), ": ");
    whole +=
        std::string(rest, (*each)[0].first) + fmt::format("const {{{}}} = $modules['{}'];", names, (*each)[2].str());
    rest = (*each)[0].second;
  }
  whole.append(rest, text.cend());
  whole = std::regex_replace(whole, kLazyImport, "$$load('$1')");
  whole = std::regex_replace(whole, std::regex("import\\.meta\\.url"), "$$base");
  return fmt::format("$modules['{}'] = (() => {{{}\nreturn {{ {} }};\n}})();\n", name, whole,
                     fmt::join(exported, ", "));
}

bool is_left_out(std::string_view name, PageHost host) {
  if (name.starts_with("studio") || name.starts_with("merge-curve")) return host != PageHost::kStudio;
  return name == "share.js" && host == PageHost::kFolder;
}

constexpr std::string_view kLayered = "layered.js", kObjects = "objects.js", kTranslate = "translate.js";

// A script with a module that few pages need, and the modules that only this one imports.
struct RareScript {
  std::string_view name;
  std::string_view module;  // or, with all that it imports on demand, translate.js
  bool needs_rest = false;  // it imports from later.js
};
constexpr RareScript kRareScripts[] = {{"later-tour.js", "tour.js"},
                                       {"later-words.js", kTranslate},
                                       {"later-objects.js", "objects-panorama.js", true},
                                       {"later-film.js", "layered-film.js", true},
                                       {"later-layers.js", "layers.js"}};
static_assert(std::size(kRareScripts) + 1 == std::size(kLaterScripts));

std::vector<std::string> modules_of(const RareScript& script) {
  if (script.module != kTranslate) return {std::string(script.module)};
  return names_in(std::string(find_page_file(kTranslate)->data), kLazyImport, 1);
}

bool is_rare(std::string_view name, PageHost host) {
  const bool is_scene = name == kLayered || name == kObjects;
  return (is_scene && host == PageHost::kFolder) || std::ranges::any_of(kRareScripts, [&](const RareScript& script) {
           return std::ranges::count(modules_of(script), name) > 0;
         });
}

struct Modules {
  std::set<std::string> known;
  std::string script;
  std::vector<std::string> later;  // modules that they import on demand
  bool has_rare = false;           // among them
};

// Only ASCII, with \uXXXX for the rest, which strings and regular expressions mean the same by: a classic script has the
// encoding of the page that loads it, which plain pages do not declare. text: UTF-8.
std::string ascii(std::string_view text, PageHost host) {
  if (host != PageHost::kFolder) return std::string(text);  // our server declares it
  std::string out;
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    if (lead < 0x80) {
      out += static_cast<char>(lead);
      continue;
    }
    const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
    uint32_t code = lead & (0x3fu >> more);
    for (int k = 0; k < more && i < text.size(); k++)
      code = code << 6 | (static_cast<unsigned char>(text[i++]) & 0x3fu);
    if (code > 0xffff) {
      out += fmt::format("\\u{:04x}\\u{:04x}", 0xd800 + ((code - 0x10000) >> 10), 0xdc00 + (code & 0x3ff));
    } else {
      out += fmt::format("\\u{:04x}", code);
    }
  }
  return out;
}

// After its imports.
void add(const std::string& name, PageHost host, Modules& modules) {
  if (is_left_out(name, host) || !modules.known.insert(name).second) return;
  const std::string text(find_page_file(name)->data);
  for (const std::string& other : names_in(text, kImport, 2)) add(other, host, modules);
  for (const std::string& other : names_in(text, kLazyImport, 1)) modules.later.push_back(other);
  modules.script += wrapped(name, text);
}

void add_later(PageHost host, Modules& modules) {
  while (!modules.later.empty()) {
    const std::string name = modules.later.back();
    modules.later.pop_back();
    if (is_rare(name, host)) {
      modules.has_rare = true;
    } else {
      add(name, host, modules);
    }
  }
}

// The scripts of the modules that are in another one than later.js, for web/bundle.js.
std::string rare_scripts() {
  Json names = Json::object();
  for (const RareScript& script : kRareScripts) {
    for (const std::string& module : modules_of(script)) names[module] = script.name.substr(0, script.name.rfind('.'));
  }
  return fmt::format("const $rare = {};\n", names.dump());
}

// The code for the first view.
Modules first_of(const std::string& entry, PageHost host) {
  Modules modules;
  if (host == PageHost::kStudio) add("studio.js", host, modules);
  add(entry, host, modules);
  return modules;
}

// The modules of later.js.
void add_rest(PageHost host, Modules& modules) {
  if (host == PageHost::kFolder) add(std::string(kLayered), host, modules), add(std::string(kObjects), host, modules);
  add_later(host, modules);
}

}  // namespace

constexpr std::string_view kNotice = "// Made by Omnistereo from its modules.\n";

std::string bundle(const std::string& entry, PageHost host, ScriptKind kind) {
  Modules all = first_of(entry, host);
  if (host == PageHost::kFolder) add_later(host, all);
  const std::string script = rare_scripts() + std::string(find_page_file("bundle.js")->data) + all.script;
  if (kind == ScriptKind::kClassic) {
    return ascii(fmt::format("{}(() => {{\n'use strict';\nconst $base = document.currentScript?.src;\n{}}})();\n",
                             kNotice, script),
                 host);
  }
  const std::string exported =
      fmt::format("{}", fmt::join(names_in(std::string(find_page_file(entry)->data), kExport, 3), ", "));
  std::string import_later;
  if (all.has_rare) {
    for (const std::string_view file : kLaterScripts) {
      const std::string_view stem = file.substr(0, file.rfind('.'));
      import_later += fmt::format("{}'{}': () => import('./{}.mjs')", import_later.empty() ? "" : ", ", stem, stem);
    }
    import_later = fmt::format("const $bring = {{ {} }};\n", import_later);
  }
  return fmt::format("{}const $base = import.meta.url;\n{}{}export const {{ {} }} = $modules['{}'];\n", kNotice,
                     import_later, script, exported, entry);
}

std::string bundle_later(std::string_view name, PageHost host, ScriptKind kind) {
  if (std::ranges::find(kLaterScripts, name) == std::end(kLaterScripts)) return "";
  const auto rare = std::ranges::find(kRareScripts, name, &RareScript::name);
  Modules modules = first_of("main.js", host);
  if (host == PageHost::kFolder) add_later(host, modules);
  if (rare == std::end(kRareScripts)) {
    modules.script.clear();
    add_rest(host, modules);
  } else {
    if (rare->needs_rest) add_rest(host, modules);
    modules.script.clear(), modules.later.clear();
    for (const std::string& module : modules_of(*rare)) add(module, host, modules);
    add_later(host, modules);
  }
  return ascii(
      fmt::format("{}{} = ($modules, $load, $base, fetch) => {{\n'use strict';\n{}}};\n", kNotice,
                  kind == ScriptKind::kModule ? "export const later" : "window.omnistereoLater", modules.script),
      host);
}

std::string script_of_file(std::string_view name, std::string_view bytes) {
  return fmt::format(
      "var stereo360Files = window.stereo360Files || {{}};\n"
      "stereo360Files[document.currentScript.src.slice(0, -3)] = 'data:{};base64,{}';\n",
      media_type(name), encode_base64(bytes));
}

}  // namespace ods
