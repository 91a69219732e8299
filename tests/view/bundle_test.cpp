// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/bundle.h"

#include <gtest/gtest.h>

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

// A server's page is in two scripts, a folder's in one.
TEST(Bundle, WhatIsWantedLaterIsInAScriptOfItsOwn) {
  const auto modules_in = [](const std::string& script) {
    const std::regex made(R"(\$modules\['([\w.-]+)'\] = \()");
    std::set<std::string> names;
    for (std::sregex_iterator each(script.begin(), script.end(), made), end; each != end; ++each) {
      EXPECT_TRUE(names.insert((*each)[1]).second) << (*each)[1] << " twice";
    }
    return names;
  };
  const std::set<std::string> folder = modules_in(bundle("main.js"));
  for (const PageHost host : {PageHost::kView, PageHost::kStudio}) {
    const std::set<std::string> first = modules_in(bundle("main.js", host)), later = modules_in(bundle_later(host));
    for (const std::string& name : folder) EXPECT_EQ(first.count(name) + later.count(name), 1u) << name;
    EXPECT_TRUE(first.contains("viewer.js") && later.contains("compare.js") && later.contains("headset-panel.js") &&
                later.contains("share.js"));
    EXPECT_EQ(first.contains("studio.js"), host == PageHost::kStudio);
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
