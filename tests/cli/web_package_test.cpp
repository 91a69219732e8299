// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The package stereo-360 as web developers install it: packed and installed by npm, imported in Node, bundled by
// esbuild, in plain pages, type-checked, and in three.js. ODS_NODE_MODULES names a folder with esbuild, typescript and
// three; what is missing there, or on this machine, skips its test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/http/http_server.h"
#include "ods/base/error.h"
#include "ods/base/gzip.h"
#include "ods/base/json_reader.h"
#include "ods/files/atomic_file.h"
#include "ods/view/bundle.h"
#include "ods/view/package.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"
#include "tests/support/places.h"

namespace ods::web_package_test {

constexpr auto kPatience = std::chrono::seconds(200);

const std::map<std::string, std::string>& our_files() {
  static const std::map<std::string, std::string> files = package_files(source_folder() + "/web/package");
  return files;
}

// The size of each script as a page loads it, gzipped.
TEST(WebPackage, IsSmall) {
  const auto size_of = [](const char* name) { return gzip(our_files().at(name)).size(); };
  fmt::print("gzipped: element {} bytes, mesh for three.js {}, for A-Frame {}\n", size_of("stereo-360.mjs"),
             size_of("three.mjs"), size_of("aframe.js"));
  EXPECT_LE(size_of("stereo-360.mjs"), 70'000u);
  EXPECT_LE(size_of("stereo-360.js"), 70'000u);
  EXPECT_LE(size_of("three.mjs"), 9'500u);
  EXPECT_LE(size_of("aframe.js"), 10'000u);
}

// package.json names files that are there; the version is ours; the script is the one that exports have.
TEST(WebPackage, IsWhole) {
  const std::map<std::string, std::string> all = our_files();
  const Json package = Json::parse(all.at("package.json"));
  EXPECT_EQ(package["version"], ODS_VERSION);
  const auto check = [&](const Json& path) { EXPECT_TRUE(all.contains(path.get<std::string>().substr(2))) << path; };
  for (const char* const field : {"main", "module", "types", "unpkg", "jsdelivr"}) check(package[field]);
  for (const auto& [name, exported] : package["exports"].items()) {
    if (exported.is_string()) check(exported);
    if (exported.is_object()) check(exported["default"]), check(exported["types"]);
  }
  EXPECT_TRUE(all.contains(package["customElements"].get<std::string>()));
  EXPECT_EQ(all.at("stereo-360.js"), bundle("stereo-360.js"));
  EXPECT_EQ(all.count("make.cpp"), 0u);
}

TEST(WebPackage, HasTheTypesOfItsReadme) {
  const std::string readme = our_files().at("README.md"), types = element_types(readme);
  for (const char* const part :
       {"export type Layout = 'mono' | 'top-bottom' | ", "export type Projection = 'lat-long' | 'vr180' | ",
        "export type Mode = 'left' | 'right' | ", "  controls?: 'none' | 'all';\n", "  fov: number;\n",
        "  'aria-label'?: string;\n", "  progress: CustomEvent<number | null>;\n", "  readonly loaded: boolean;\n",
        "  set item(value: string | number | null);\n", "  enterHeadset: () => Promise<void>;\n"}) {
    EXPECT_NE(types.find(part), std::string::npos) << part << "\n" << types;
  }
  EXPECT_THROW(element_types("# Nothing\n"), Error);
  const Json element = Json::parse(element_manifest(readme))["modules"][0]["declarations"][0];
  EXPECT_EQ(element["tagName"], "stereo-360");
  EXPECT_GT(element["attributes"].size(), 14u);
  EXPECT_EQ(element["events"].size(), 7u);
}

class InstalledPackage : public Cli {
 protected:
  void SetUp() override {
    if (find_program({"npm"}).empty()) GTEST_SKIP() << "skipped: there is no npm";
    for (const auto& [name, text] : our_files()) {
      const std::filesystem::path path = folder.path("package/" + name);
      std::filesystem::create_directories(path.parent_path());
      write_file(path.native(), text);
    }
    std::filesystem::create_directory(folder.path("page"));
    folder.write("page/package.json", R"({"private": true, "type": "module"})");
    const std::string quiet = " --silent --offline --no-audit --no-fund --cache '" + folder.path("cache") + "'";
    ASSERT_EQ(shell("cd package && npm pack --pack-destination .." + quiet), 0) << said();
    ASSERT_EQ(shell("cd page && npm install ../stereo-360-*.tgz" + quiet), 0) << said();
  }

  int shell(const std::string& command) const {
    return std::system(("cd '" + folder.path("") + "' && (" + command + ") >said 2>&1").c_str());
  }
  std::string said() const { return folder.read("said"); }

  // A program of ODS_NODE_MODULES; empty if it is missing.
  static std::string tool(const std::string& name) {
    const char* const modules = std::getenv("ODS_NODE_MODULES");
    const std::string path = modules ? std::string(modules) + "/.bin/" + name : "";
    return std::filesystem::exists(path) ? path : "";
  }

  // Writes a page of a picture and its script, and opens it; returns what it posts to `done`.
  std::string browse(const std::string& scripts) {
    if (run("testcard -q --width 256 -o " + folder.path("page/card_360_TB.png")) != 0) return err;
    folder.write("page/report.js", kReport);
    folder.write("page/index.html", "<!DOCTYPE html>\n<stereo-360 src=\"card_360_TB.png\"></stereo-360>\n" + scripts);
    const auto answer = [this](const WebRequest& request) -> WebAnswer {
      const std::string place = folder.path("page/" + request.path);
      if (!std::filesystem::is_regular_file(place)) return nothing_there();
      return {.type = std::string(media_type(place)), .file = std::filesystem::canonical(place)};
    };
    return run_in_browser({chromium(folder.path("profile")), folder.path("home"), "index.html", answer, kPatience});
  }

  static constexpr const char* kReport = R"(
const element = document.querySelector('stereo-360');
const say = (text) => fetch('done', { method: 'POST', body: text });
element.addEventListener('error', ({ detail }) => say(detail.message));
element.addEventListener('load', () => say(`loaded, ${element.shadowRoot.querySelectorAll('#bar button').length > 4}`));
)";
};

// Servers that render pages import it, too.
TEST_F(InstalledPackage, IsImportedWithoutABrowser) {
  folder.write("page/main.js", R"(
import { Stereo360 } from 'stereo-360';
import { makePanorama } from 'stereo-360/three';
import { registerStereo360 } from 'stereo-360/aframe';
console.log(Stereo360.layouts.includes('top-bottom'), Stereo360.projections.includes('vr180'), typeof makePanorama, typeof registerStereo360);
)");
  EXPECT_EQ(shell("cd page && node main.js"), 0);
  EXPECT_EQ(said(), "true true function function\n");
}

TEST_F(InstalledPackage, RunsInAPlainPage) {
  NEEDS_CHROMIUM();
  EXPECT_EQ(
      browse("<script src=\"report.js\"></script><script src=\"node_modules/stereo-360/stereo-360.js\"></script>"),
      "loaded, true");
}

TEST_F(InstalledPackage, RunsInABundledPage) {
  NEEDS_CHROMIUM();
  if (tool("esbuild").empty()) GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no esbuild (npm install esbuild)";
  folder.write("page/main.js", "import 'stereo-360';\nimport './report.js';\n");
  folder.write("page/report.js", kReport);
  for (const char* const format : {"esm", "iife"}) {
    ASSERT_EQ(shell(fmt::format("cd page && '{}' main.js --bundle --minify --outfile=bundled.js --format={} "
                                "--log-override:empty-import-meta=silent",
                                tool("esbuild"), format)),
              0)
        << said();
    EXPECT_EQ(browse("<script type=\"module\" src=\"bundled.js\"></script>"), "loaded, true") << format;
  }
}

TEST_F(InstalledPackage, IsTypeChecked) {
  if (tool("tsc").empty()) GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no typescript (npm install typescript)";
  const auto check = [this](const std::string& text) {
    folder.write("page/main.ts",
                 "import { Stereo360, type Look } from 'stereo-360';\n"
                 "import { makePanorama } from 'stereo-360/three';\n" +
                     text);
    return shell("cd page && '" + tool("tsc") +
                 "' --strict --noEmit --types '' --module nodenext --target es2022 --lib es2022,dom main.ts");
  };
  EXPECT_EQ(check(R"(
const element = document.querySelector('stereo-360')!;
element.addEventListener('look', ({ detail }) => { const { yaw }: Look = detail; element.yaw = yaw; });
element.addEventListener('error', ({ detail }) => console.log(detail.message));
element.addEventListener('click', () => element.enterHeadset());
element.item = 3; element.src = null; element.mode = 'anaglyph';
const tag: JSX.IntrinsicElements['stereo-360'] = { src: 'a.jpg', layout: 'top-bottom', controls: 'none' };
class Mesh { rotation = { y: 0 }; }
makePanorama({ Mesh }, { texture: null, projection: 'vr180' }).rotation.y = 1;
console.log(tag, Stereo360.layouts[0], element.screenshot()?.then((blob) => blob.size));
)"),
            0)
      << said();
  EXPECT_NE(check("document.querySelector('stereo-360')!.mode = 'upside-down';\n"), 0) << "any mode is taken";
}

// The mesh shows what the element shows, for each eye.
TEST_F(InstalledPackage, RunsInThreeJs) {
  NEEDS_CHROMIUM();
  if (tool("esbuild").empty() || !std::filesystem::exists(std::string(std::getenv("ODS_NODE_MODULES")) + "/three")) {
    GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no esbuild and three (npm install esbuild three)";
  }
  folder.write("page/main.js", R"(
import * as THREE from 'three';
import 'stereo-360';
import { makePanorama } from 'stereo-360/three';
const say = (text) => fetch('done', { method: 'POST', body: text });
const element = document.querySelector('stereo-360');
Object.assign(element.style, { width: '120px', height: '90px' });
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(120, 90);
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(60, 4 / 3);
const pixels = (canvas) => {
  const copy = new OffscreenCanvas(120, 90).getContext('2d');
  copy.drawImage(canvas, 0, 0, 120, 90);
  return copy.getImageData(0, 0, 120, 90).data;
};
const difference = (a, b) => a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;
const settled = () => new Promise((done) => element.viewer.addEventListener('settled', done, { once: true }));
async function test() {
  const texture = await new THREE.TextureLoader().loadAsync('card_360_TB.png');
  const panorama = makePanorama(THREE, { texture });
  scene.add(panorama);
  const shown = [];
  for (const [eye, layer] of [['left', 1], ['right', 2]]) {
    const still = settled();
    element.lookAt({ mode: eye, yaw: 30, pitch: -20, fov: 2 * Math.atan(Math.tan(Math.PI / 6) * 4 / 3) * 180 / Math.PI });
    await still;
    camera.layers.set(0);
    camera.layers.enable(layer);
    camera.rotation.set(-20 * Math.PI / 180, -30 * Math.PI / 180, 0, 'YXZ');
    renderer.render(scene, camera);
    const [ours, theirs] = [pixels(element.viewer.canvas), pixels(renderer.domElement)];
    if (difference(ours, theirs) > 8) return `${eye}: they differ by ${difference(ours, theirs)}`;
    shown.push(theirs);
  }
  if (!(difference(...shown) > 0.2)) return `both eyes are the same, to ${difference(...shown)}`;
  scene.remove(panorama);
  scene.add(makePanorama(THREE, { texture, swap: true }));
  renderer.render(scene, camera); // of the right eye
  if (difference(pixels(renderer.domElement), shown[0]) > 0.01) return 'swapped, the right eye does not see the left picture';
  try {
    makePanorama(THREE, { texture, layout: 'inside-out' });
    return 'it takes any layout';
  } catch (error) {
    return error.message.startsWith('"inside-out" is not a layout. There are: mono, top-bottom') ? 'ok' : error.message;
  }
}
element.addEventListener('load', () => test().then(say, (error) => say(error.stack)), { once: true });
)");
  ASSERT_EQ(shell("cd page && NODE_PATH=\"$ODS_NODE_MODULES\" '" + tool("esbuild") +
                  "' main.js --bundle --format=esm --outfile=bundled.js"),
            0)
      << said();
  EXPECT_EQ(browse("<script type=\"module\" src=\"bundled.js\"></script>"), "ok");
}

}  // namespace ods::web_package_test
