// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/bundle.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "ods/view/page.h"

using namespace ods;

// Browsers run it as a classic script: page_browser_test does. Here, that nothing of modules is left in it.
TEST(Bundle, IsNoModule) {
  for (const char* const entry : {"main.js", "stereo-360.js"}) {
    const std::string script = bundle(entry);
    for (const char* const word : {"\nimport ", "\nexport ", "import(", "import.meta"}) {
      EXPECT_EQ(script.find(word), std::string::npos) << entry << ": " << word;
    }
    EXPECT_EQ(script.find("studio-panel"), std::string::npos) << entry;
  }
  for (const PageHost host : {PageHost::kFolder, PageHost::kView, PageHost::kStudio}) {
    for (const std::string_view later : kLaterScripts) {
      const std::string script = bundle_later(later, host);
      for (const char* const word : {"\nimport ", "\nexport ", "import("}) {
        EXPECT_EQ(script.find(word), std::string::npos) << later << ": " << word;
      }
    }
  }
}

// In Node, with which sites are made, it imports, too: page_browser_test and web_package_test do so.
TEST(Bundle, IsAModuleWhereThatIsWanted) {
  const std::string script = bundle("stereo-360.js", PageHost::kFolder, ScriptKind::kModule);
  EXPECT_NE(script.find("\nexport const { Stereo360 } = $modules['stereo-360.js'];\n"), std::string::npos);
  EXPECT_NE(script.find("\nconst $base = import.meta.url;\n"), std::string::npos);
  EXPECT_EQ(script.find("currentScript"), std::string::npos);
}

// A server's script has what only a server answers.
TEST(Bundle, HasWhatItsHostAnswers) {
  const auto has = [](PageHost host, const char* module) {
    return bundle("main.js", host).find(std::string("$modules['") + module + "'] = (") != std::string::npos;
  };
  for (const PageHost host : {PageHost::kFolder, PageHost::kView, PageHost::kStudio}) {
    EXPECT_TRUE(has(host, "viewer.js"));
    EXPECT_EQ(has(host, "list.js"), host == PageHost::kFolder) << "servers send it later";
    EXPECT_EQ(has(host, "studio.js"), host == PageHost::kStudio);
  }
}

static std::set<std::string> modules_in(const std::string& script) {
  const std::regex made(R"(\$modules\['([\w.-]+)'\] = \()");
  std::set<std::string> names;
  for (std::sregex_iterator each(script.begin(), script.end(), made), end; each != end; ++each) {
    EXPECT_TRUE(names.insert((*each)[1]).second) << (*each)[1] << " twice";
  }
  return names;
}

// A server's page is in two scripts, a folder's in one, but for layered scenes.
TEST(Bundle, WhatIsWantedLaterIsInAScriptOfItsOwn) {
  const std::set<std::string> folder = modules_in(bundle("main.js"));
  for (const PageHost host : {PageHost::kView, PageHost::kStudio}) {
    const std::set<std::string> first = modules_in(bundle("main.js", host)),
                                later = modules_in(bundle_later("later.js", host));
    for (const std::string& name : folder) EXPECT_EQ(first.count(name) + later.count(name), 1u) << name;
    EXPECT_TRUE(first.contains("viewer.js") && later.contains("compare.js") && later.contains("headset-panel.js") &&
                later.contains("share.js"));
    EXPECT_EQ(first.contains("studio.js"), host == PageHost::kStudio);
  }
}

// The page and the element load the same script, which may use only what both have.
void expect_known(const std::string& script, const std::set<std::string>& later, PageHost host = PageHost::kFolder) {
  const std::regex use(R"(\$modules\['([\w.-]+)'\];)");
  for (const char* const entry : {"main.js", "stereo-360.js"}) {
    if (host != PageHost::kFolder && entry != std::string("main.js")) continue;
    const std::set<std::string> first = modules_in(bundle(entry, host));
    for (std::sregex_iterator each(script.begin(), script.end(), use), end; each != end; ++each) {
      EXPECT_EQ(first.count((*each)[1]) + later.count((*each)[1]), 1u) << entry << ": " << (*each)[1];
    }
  }
}

// Few pages have hotspots or a tour.
TEST(Bundle, ToursAreApart) {
  const std::string script = bundle_later("later-tour.js", PageHost::kFolder);
  const std::set<std::string> later = modules_in(script);
  EXPECT_EQ(later, (std::set<std::string>{"notes.js", "tour.js", "tour-plan.js", "tour-style.js", "tour-ways.js",
                                          "tour-worn.js"}));
  expect_known(script, later);
  for (const PageHost host : {PageHost::kView, PageHost::kStudio}) {
    EXPECT_FALSE(modules_in(bundle("main.js", host)).contains("tour.js"));
    EXPECT_FALSE(modules_in(bundle_later("later.js", host)).contains("tour.js"));
    const std::string served = bundle_later("later-tour.js", host);
    expect_known(served, modules_in(served), host);
  }
  EXPECT_EQ(bundle_later("later-other.js", PageHost::kFolder), "");
}

// Few pages are in another language.
TEST(Bundle, WordsAreApart) {
  const std::set<std::string> words = {"translations-de.js", "translations-fr.js"};
  for (const PageHost host : {PageHost::kFolder, PageHost::kView, PageHost::kStudio}) {
    EXPECT_EQ(modules_in(bundle_later("later-words.js", host)), words);
    for (const std::string& script : {bundle("main.js", host), bundle_later("later.js", host)}) {
      for (const std::string& name : words) EXPECT_FALSE(modules_in(script).contains(name)) << name;
    }
  }
}

// Few pages have layered scenes.
TEST(Bundle, AFolderHasTheCodeOfLayeredScenesApart) {
  const std::string script = bundle_later("later.js", PageHost::kFolder);
  const std::set<std::string> later = modules_in(script);
  EXPECT_EQ(later, (std::set<std::string>{"glb.js", "layered-draw.js", "layered.js", "meshopt.js", "objects.js",
                                          "objects-draw.js", "objects-file.js", "objects-hands.js", "objects-light.js",
                                          "objects-panel.js", "objects-shaders.js", "objects-surface.js"}));
  expect_known(script, later);
  const auto imports = [](const char* entry) {
    return bundle(entry, PageHost::kFolder, ScriptKind::kModule).find("import('./later.mjs')") != std::string::npos;
  };
  EXPECT_TRUE(imports("stereo-360.js"));
  EXPECT_FALSE(imports("three.js")) << "it has no use for it";
  EXPECT_NE(bundle_later("later.js", PageHost::kFolder, ScriptKind::kModule).find("\nexport const later = ("),
            std::string::npos);
}

// Few pages have objects in pictures. Their script comes after later.js, from which it imports.
TEST(Bundle, ObjectsInPicturesAreApart) {
  for (const PageHost host : {PageHost::kFolder, PageHost::kView, PageHost::kStudio}) {
    const std::string script = bundle_later("later-objects.js", host);
    std::set<std::string> known = modules_in(script);
    EXPECT_EQ(known, (std::set<std::string>{"objects-panorama.js", "objects-split.js", "objects-stage-shaders.js"}));
    EXPECT_FALSE(modules_in(bundle("main.js", host)).contains("objects-panorama.js"));
    const std::set<std::string> later = modules_in(bundle_later("later.js", host));
    EXPECT_FALSE(later.contains("objects-panorama.js"));
    known.insert(later.begin(), later.end());
    expect_known(script, known, host);
  }
}

// A page that does not declare its encoding reads a classic script by another one than UTF-8.
TEST(Bundle, IsAscii) {
  for (const std::string& script : {bundle("stereo-360.js"), bundle_later("later-words.js", PageHost::kFolder)}) {
    EXPECT_TRUE(std::ranges::all_of(script, [](char each) { return static_cast<unsigned char>(each) < 0x80; }));
  }
  EXPECT_NE(bundle("stereo-360.js").find("\\u00b0"), std::string::npos) << "degrees";
  EXPECT_NE(bundle_later("later-words.js", PageHost::kFolder).find("zur\\u00fcck"), std::string::npos);
}

// Few browsers have layers.
TEST(Bundle, LayersOfHeadsetsAreApart) {
  const std::set<std::string> layers = {"layers.js", "media-layer.js"};
  for (const PageHost host : {PageHost::kFolder, PageHost::kView, PageHost::kStudio}) {
    const std::string script = bundle_later("later-layers.js", host);
    EXPECT_EQ(modules_in(script), layers);
    expect_known(script, layers, host);
    EXPECT_FALSE(modules_in(bundle_later("later.js", host)).contains("layers.js"));
  }
}

// A page finds the script of each module that is not in later.js.
TEST(Bundle, KnowsTheScriptsOfRareModules) {
  const std::string script = bundle("main.js");
  for (const auto& [module, file] : {std::pair{"tour", "later-tour"},
                                     {"translations-de", "later-words"},
                                     {"translations-fr", "later-words"},
                                     {"objects-panorama", "later-objects"},
                                     {"layered-film", "later-film"},
                                     {"layers", "later-layers"}}) {
    const std::regex names(fmt::format(R"(\$rare = \{{[^}}]*"{}\.js": ?"{}")", module, file));
    EXPECT_TRUE(std::regex_search(script, names)) << module;
  }
}

// Few layered scenes are films.
TEST(Bundle, FilmsAreApart) {
  for (const PageHost host : {PageHost::kFolder, PageHost::kView, PageHost::kStudio}) {
    const std::string script = bundle_later("later-film.js", host);
    EXPECT_EQ(modules_in(script), std::set<std::string>{"layered-film.js"});
    std::set<std::string> known = modules_in(bundle_later("later.js", host));
    EXPECT_FALSE(known.contains("layered-film.js"));
    known.insert("layered-film.js");
    expect_known(script, known, host);
  }
}

// The imports of a module are made before it.
TEST(Bundle, ModulesComeBehindWhatTheyImport) {
  const std::string script = bundle("main.js");
  const std::regex use(R"(\$modules\['([\w.-]+)'\];)");
  size_t count = 0;
  for (std::sregex_iterator each(script.begin(), script.end(), use), end; each != end; ++each, ++count) {
    const size_t made = script.find("$modules['" + (*each)[1].str() + "'] = (");
    EXPECT_LT(made, static_cast<size_t>(each->position())) << (*each)[1];
  }
  EXPECT_GT(count, 20u);
}

TEST(Bundle, AFilesScriptHasItsBytes) {
  const std::string script = script_of_file("item/0/a.png", "abc");
  EXPECT_NE(script.find("'data:image/png;base64,YWJj'"), std::string::npos) << script;
}
