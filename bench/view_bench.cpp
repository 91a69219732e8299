// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Cost of a frame of the viewer, in CPU milliseconds of a Chromium with a software GPU: while it moves, at rest, and
// for comparison the simplest shader for a lat-long picture, one bilinear look-up, in the same run; the parts of a
// film's frame; the next picture of a folder; and an edit in the studio. Also the time until a large picture is visible,
// and sharp, and the memory of the page and its server.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <atomic>
#include <map>
#include <mutex>

#include "bench/measure.h"
#include "cli/view/export_site.h"
#include "cli/view/view_site.h"
#include "ods/files/read_file.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/places.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/worlds.h"

namespace {

using namespace ods;

constexpr int kMovingFrames = 40, kStillFrames = 2;
constexpr int kWidth = 640, kHeight = 360;

// The start of scripts that measure frames: measure() runs `run` once, then `count` times between reports of the start
// and the end; the mean is of all its calls with a name. Each frame is read back, because drivers would defer it. plainOf()
// makes a function that draws a source with the simplest shader for a lat-long picture, one bilinear look-up.
const std::string kMeasure = R"(
import { Panorama, compile, raysOf } from './panorama.js';
import { openPicture } from './picture.js';
const post = (path, body = '') => fetch(path, { method: 'POST', body });
const [width, height, moving, still] = (await (await fetch('sizes')).text()).split(' ').map(Number);
const canvas = Object.assign(document.createElement('canvas'), { width, height });
document.body.append(canvas);
const view = await (await fetch('view.json')).json();
const panorama = new Panorama(canvas);
const { gl } = panorama;
const pixel = new Uint8Array(4);
async function measure(name, count, run) {
  const frame = (i) => {
    run(i);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  };
  frame(0);
  await post('begin');
  for (let i = 1; i <= count; i++) frame(i);
  await post(`end/${name}/${count}`);
}
const PLAIN = `#version 300 es
precision highp float;
uniform sampler2D picture;
uniform mat3 rays;
in vec2 screen;
out vec4 color;
void main() {
  vec3 d = normalize(rays * vec3(screen, 1.0));
  color = texture(picture, vec2(0.5 + atan(d.x, -d.z) / 6.2831853, 0.5 - asin(d.y) / 3.1415927));
}`;
const turned = (i) => raysOf({ yaw: 1.5 * i, pitch: 0.5 * i, fov: 90 }, width / height);
function plainOf(source) {
  const texture = gl.createTexture();
  const use = () => {
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
  };
  use();
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, source);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  const program = compile(gl, PLAIN);
  return (i) => {
    use();
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.useProgram(program);
    gl.uniformMatrix3fv(gl.getUniformLocation(program, 'rays'), false, turned(i));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  };
}
)";

// Draws frames while the look turns.
const std::string kScript = kMeasure + R"(
try {
  const picture = await openPicture(panorama, view, view.items[0], {});
  const plain = plainOf(await createImageBitmap(await (await fetch(view.items[0].image)).blob()));
  const draw = (how) => (i) => panorama.draw(picture, { rays: turned(i), box: [0, 0, width, height], ...how });
  // In turns, because other programs have a part of the processors' caches.
  for (let round = 0; round < 5; round++) {
    await measure('plain', moving / 5, plain);
    await measure('moving', moving / 5, draw({ moves: true, cheap: true })); // as a slow GPU is asked to, and as others are:
    await measure('fine', moving / 5, draw({ moves: true }));
    await measure('anaglyph', moving / 5, draw({ moves: true, cheap: true, show: 'anaglyph' }));
  }
  await measure('still', still, draw({}));
  await post('done', 'ok');
} catch (error) {
  await post('done', error.message);
}
)";

// Frames of a film: uploaded; the eye that is shown is cut; mip levels are made; and it is drawn, as soon as a slow GPU is
// asked to. Counts what the page itself does for a frame while the film is magnified.
const std::string kFilmScript = kMeasure + R"(
const counts = { texImage2D: 0, generateMipmap: 0, drawArrays: 0, drawElements: 0 };
for (const name of Object.keys(counts)) {
  const own = gl[name].bind(gl);
  gl[name] = (...values) => (counts[name]++, own(...values));
}
try {
  const picture = await openPicture(panorama, view, view.items[0], {});
  const { video, eyes } = picture;
  const cut = eyes[0];
  let rays = raysOf({ yaw: 20, fov: 90 }, width / height);
  const draw = () => panorama.draw(picture, { rays, box: [0, 0, width, height], moves: true, cheap: true });
  const again = () => (video.dispatchEvent(new Event('ended')), picture.refresh());
  await measure('upload', 20, again);
  await measure('upload_cut', 20, () => (again(), picture.prepare(cut, false)));
  await measure('upload_cut_mips', 20, () => (again(), picture.prepare(cut, true)));
  const plain = plainOf(video);
  for (let round = 0; round < 5; round++) {
    await measure('plain', 8, plain);
    await measure('drawing', 8, draw);
  }
  Object.assign(counts, { texImage2D: 0, generateMipmap: 0, drawArrays: 0, drawElements: 0 });
  for (let i = 0; i < 20; i++) again(), draw();
  for (const [name, count] of Object.entries(counts)) await post(`count/${name}_per_frame/${count / 20}`);
  await post('done', 'ok');
} catch (error) {
  await post('done', error.stack);
}
)";

// The next picture of a folder, milliseconds from the key until the GPU has drawn the first frame of it: when the view
// rests and both neighbours are there, and when the key is pressed again a second later, as by who leafs through.
const std::string kFolderScript = R"(
const post = (path, body = '') => fetch(path, { method: 'POST', body });
const sleep = (time) => new Promise((done) => setTimeout(done, time));
const pixel = new Uint8Array(4);
try {
  while (!window.omnistereo?.viewer.picture) await sleep(50);
  const { viewer } = window.omnistereo;
  const heard = (name) => new Promise((done) => viewer.addEventListener(name, done, { once: true }));
  const next = async () => {
    const since = performance.now();
    const opened = heard('open');
    document.dispatchEvent(new KeyboardEvent('keydown', { key: 'PageDown', bubbles: true }));
    await opened;
    await new Promise(requestAnimationFrame);
    const { gl } = viewer.panorama;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return performance.now() - since;
  };
  const report = (name, times) => {
    times.sort((a, b) => a - b);
    return Promise.all([post(`count/${name}_ms/${times[times.length >> 1]}`), post(`count/${name}_worst_ms/${times.at(-1)}`)]);
  };
  const rested = [], leafed = [];
  for (let i = 0; i < 5; i++) {
    viewer.redraw();
    await heard('settled');
    for (let k = 0; k < 300 && ![...viewer.ahead.kept.values()].every(({ isReady }) => isReady); k++) await sleep(100);
    rested.push(await next());
  }
  await report('rested', rested);
  for (let i = 0; i < 5; i++) {
    await sleep(1000);
    leafed.push(await next());
  }
  await report('leafed', leafed);
  await post('done', 'ok');
} catch (error) {
  await post('done', error.stack);
}
)";

class Frames {
 public:
  // Milliseconds by name.
  std::map<std::string, double> measure(const StereoCamera& stereo, Extent eye) {
    const Folder folder;
    const std::string path = folder.path("picture.png");
    save(stereo, eye, path);
    FormatHint known;
    known.layout = Layout::kTopBottom;
    known.projection = stereo.projection;
    std::vector<ViewItem> items = {open_view_item(path, known)};
    items[0].picture.camera = stereo;
    return run(items, "bench.html", kScript, folder);
  }

  // Measures a page with files that ods testcard makes.
  std::map<std::string, double> measure(const std::vector<std::string>& cards, const std::string& page,
                                        const std::string& script) {
    const Folder folder;
    std::vector<ViewItem> items;
    for (const std::string& card : cards) {
      const std::string path = folder.path(card.substr(0, card.find(' ')));
      const std::string how = card.substr(card.find(' '));
      if (std::system((ods_command() + " testcard -q -o " + path + how).c_str()) != 0) return {};
      items.push_back(open_view_item(path));
    }
    return run(items, page, script, folder);
  }

  std::string end_;

 private:
  static void save(const StereoCamera& stereo, Extent eye, const std::string& path) {
    MadePicture made = make_picture(stereo, eye, {kLeft, kRight});
    const Camera camera = make_camera(stereo);
    add_colour(made, [&camera](int which, vec2 uv, float* out) {
      const Ray ray = camera_ray(camera, which, uv);
      vec3 light(0.0f);
      if (ray.direction != vec3(0.0f)) light = world_at(World::kHall, ray.origin, ray.direction);
      for (int c = 0; c < 3; c++) out[c] = light[c];
    });
    made.picture.is_float = true;
    SaveOptions options;
    options.layout = Layout::kTopBottom;
    save_picture(convert(made.picture, same_format(made.picture)).rows, nullptr, options, path);
  }

  std::map<std::string, double> run(const std::vector<ViewItem>& items, const std::string& page,
                                    const std::string& script, const Folder& folder) {
    export_site(items, folder.path("site"));
    script_ = script;
    end_ = run_in_browser({chromium(folder.path("profile")), folder.path("home"), page,
                           [&](const WebRequest& request) { return answer(request, folder.path("site/")); },
                           std::chrono::minutes(5), [this](pid_t browser) { browser_ = browser; }});
    if (end_ != "ok") times_.clear();
    return times_;
  }

  void hear(const std::string& path) {
    const double now = cpu_seconds_of(browser_);
    if (path == "begin") begin_ = now;
    const size_t from = path.find('/'), slash = path.rfind('/');
    if (from == slash) return;
    const std::string name = path.substr(from + 1, slash - from - 1);
    const double number = std::atof(path.substr(slash + 1).c_str());
    if (!path.starts_with("end/")) {
      times_[name] = number;
      return;
    }
    Sum& sum = sums_[name];
    sum.seconds += now - begin_, sum.count += number;
    times_[name] = 1000.0 * sum.seconds / sum.count;
  }

  WebAnswer answer(const WebRequest& request, const std::string& site) {
    if (request.is_post) return hear(request.path), WebAnswer{};
    const std::string tag = "<script type=\"module\" src=\"bench.js\"></script>";
    if (request.path == "bench.html") return {.type = "text/html", .body = "<!DOCTYPE html>" + tag};
    if (request.path.empty()) return {.type = "text/html", .body = read_text(site + "index.html", 1 << 20) + tag};
    if (request.path == "bench.js") return {.type = "text/javascript", .body = script_};
    if (request.path == "sizes")
      return {.body = fmt::format("{} {} {} {}", kWidth, kHeight, kMovingFrames, kStillFrames)};
    const bool is_of_site = std::filesystem::is_regular_file(site + request.path);
    const PageFile* const module = find_page_file(request.path);  // sites have them as one script
    if (module && !is_of_site)
      return {.type = std::string(media_type(request.path)), .body = std::string(module->data)};
    return {.type = std::string(media_type(request.path)), .file = site + request.path};
  }

  std::atomic<pid_t> browser_ = -1;
  std::string script_;
  struct Sum {
    double seconds = 0.0, count = 0.0;
  };
  double begin_ = 0.0;
  std::map<std::string, Sum> sums_;
  std::map<std::string, double> times_;
};

void frame(benchmark::State& state, const std::string& projection, Extent eye, bool is_toed_in) {
  StereoCamera stereo;
  stereo.projection = projection_named(projection);
  stereo.top = stereo.bottom = kUsualMerge;
  if (is_toed_in) stereo.convergence = kToeIn;
  if (chromium("").empty()) return state.SkipWithError("there is no chromium");
  for (auto _ : state) {
    Frames frames;
    const auto times = frames.measure(stereo, eye);
    if (times.empty()) return state.SkipWithError(frames.end_.c_str());
    for (const auto& [name, time] : times) state.counters[name + "_ms"] = time;
    state.counters["ratio"] = times.at("moving") / times.at("plain");
  }
}

void of_cards(benchmark::State& state, const std::vector<std::string>& cards, const std::string& page,
              const std::string& script) {
  if (chromium("").empty()) return state.SkipWithError("there is no chromium");
  for (auto _ : state) {
    Frames frames;
    const auto times = frames.measure(cards, page, script);
    if (times.empty()) return state.SkipWithError(frames.end_.c_str());
    for (const auto& [name, number] : times) state.counters[name] = number;
  }
}

// An edit in the studio: seconds until its first picture is there, in turns with a page that draws and with one that draws
// nothing.
constexpr const char* kEdits = R"(
const post = (path, body = '') => fetch(path, { method: 'POST', body });
const sleep = (time) => new Promise((done) => setTimeout(done, time));
(async () => {
  while (!window.omnistereo?.studio || !omnistereo.viewer.picture) await sleep(50);
  const { viewer, studio: { session } } = omnistereo;
  const times = { drawing: [], still: [] };
  const edit = (yaw) => new Promise((done) => {
    const since = performance.now();
    const hear = ({ detail: { samples, revision, side } }) => {
      if (!samples || side.settings !== side.sent || revision !== side.revision) return;
      session.removeEventListener('status', hear);
      done((performance.now() - since) / 1000);
    };
    session.edit({ 'sidecar.yaw': yaw });
    session.addEventListener('status', hear);
  });
  const draw = viewer.draw;
  await sleep(2000);
  const until = performance.now() + 240000; // on a machine that others use, fewer
  for (let i = 0; i < 120 && (i % 20 || performance.now() < until); i++) {
    const is = Math.floor(i / 10) % 2 === 0;
    viewer.draw = is ? draw : () => {};
    if (!is) viewer.settling = clearTimeout(viewer.rest);
    if (i % 10 === 0) await edit(200 + i); // as before a turn, too
    times[is ? 'drawing' : 'still'].push(await edit(i));
    await sleep(300);
  }
  for (const [name, all] of Object.entries(times)) {
    all.sort((a, b) => a - b);
    for (const [part, value] of [['count', all.length], ['median', all[all.length >> 1]], ['90', all[Math.floor(0.9 * all.length)]], ['worst', all.at(-1)]]) await post(`count/${name}_${part}/${value}`);
  }
  await post('done', 'ok');
})().catch((error) => post('done', error.stack));)";

void edits(benchmark::State& state) {
  const Folder folder;
  const std::vector<std::string> browser = chromium(folder.path("profile"));
  if (browser.empty()) return state.SkipWithError("there is no chromium");
  for (auto _ : state) {
    SceneSource source;
    source.name = "room";
    ViewSite site({}, source);
    std::mutex of_counters;
    const auto answer = [&](const WebRequest& request) -> WebAnswer {
      if (request.path == "edits.js") return {.type = "text/javascript", .body = kEdits};
      if (request.path.starts_with("count/")) {
        const size_t slash = request.path.rfind('/');
        const std::lock_guard lock(of_counters);
        state.counters[request.path.substr(6, slash - 6)] = std::atof(request.path.substr(slash + 1).c_str());
        return {};
      }
      WebAnswer sent = site.answer(request);
      if (request.path.empty()) sent.body += "<script src=\"edits.js\"></script>";
      return sent;
    };
    const std::string end = run_in_browser({browser, folder.path("home"), "", answer, std::chrono::minutes(8)});
    if (end != "ok") return state.SkipWithError(end.c_str());
    state.counters["worst_ratio"] = state.counters["drawing_worst"] / state.counters["still_worst"];
    state.counters["median_ratio"] = state.counters["drawing_median"] / state.counters["still_median"];
  }
}

// Seconds from the request of the page until a part of the picture is on the canvas, and until everything in the view
// is.
constexpr const char* kWatch = R"(
const now = () => (performance.now() / 1000).toFixed(3);
const post = (path, body = '') => fetch(path, { method: 'POST', body });
const pixel = new Uint8Array(4);
post('begin');
(function wait() {
  const viewer = window.omnistereo?.viewer;
  if (!viewer?.picture) return requestAnimationFrame(wait);
  viewer.addEventListener('settled', () => viewer.picture.isPreview || post('done', now()));
  requestAnimationFrame(() => {
    viewer.panorama.gl.readPixels(0, 0, 1, 1, 6408, 5121, pixel);
    post(`first/${now()}`);
  });
})();)";

void large_picture(benchmark::State& state) {
  const Folder folder;
  const std::vector<std::string> browser = chromium(folder.path("profile"));
  if (browser.empty()) return state.SkipWithError("there is no chromium");
  const std::string path = folder.path("card_360_TB.jpg");
  if (std::system((ods_command() + " testcard -q --width 8192 -o " + path).c_str()) != 0) {
    return state.SkipWithError("no test card");
  }
  for (auto _ : state) {
    forget_peak();
    state.counters["server_before_MB"] = peak_megabytes();
    ViewSite site({open_view_item(path)}, {});
    std::atomic<pid_t> process = -1;
    std::mutex of_counters;
    const auto count = [&](const std::string& name, double value) {
      const std::lock_guard lock(of_counters);
      state.counters[name] = value;
    };
    const auto answer = [&](const WebRequest& request) -> WebAnswer {
      if (request.path == "begin") return count("page_before_MB", megabytes_of(process)), WebAnswer{};
      if (request.path.starts_with("first/")) {
        count("first_s", std::atof(request.path.substr(6).c_str()));
        return count("first_cpu_s", cpu_seconds_of(process)), WebAnswer{};
      }
      if (request.path == "watch.js") return {.type = "text/javascript", .body = kWatch};
      WebAnswer sent;
      const Seconds took = seconds_of([&] { sent = site.answer(request); });
      if (request.path.ends_with("/preview.jpg")) {
        count("preview_s", took.wall);
        count("preview_cpu_s", took.cpu);
      }
      if (request.path.empty()) sent.body += "<script src=\"watch.js\"></script>";
      return sent;
    };
    const std::string end = run_in_browser({browser, folder.path("home"), "", answer, std::chrono::minutes(4),
                                            [&](pid_t started) { process = started; },
                                            [&](pid_t running) {
                                              count("page_MB", megabytes_of(running));
                                              count("sharp_cpu_s", cpu_seconds_of(running));
                                            }});
    if (std::atof(end.c_str()) <= 0.0) return state.SkipWithError(end.c_str());
    state.counters["sharp_s"] = std::atof(end.c_str());
    state.counters["server_MB"] = peak_megabytes();
  }
}

const bool registered = [] {
  benchmark::RegisterBenchmark("large_picture", large_picture)->Iterations(1)->Unit(benchmark::kSecond);
  benchmark::RegisterBenchmark("edits", edits)->Iterations(1)->Unit(benchmark::kSecond);
  benchmark::RegisterBenchmark("film", [](benchmark::State& state) {
    of_cards(state, {"film_360_TB.mp4 --video --duration 1 --fps 10 --width 1024"}, "bench.html", kFilmScript);
  })->Iterations(1);
  benchmark::RegisterBenchmark("folder", [](benchmark::State& state) {
    of_cards(state,
             {"a_360_TB.jpg --width 2048", "b_360_TB.jpg --width 2048", "c_360_TB.jpg --width 2048",
              "d_360_TB.jpg --width 2048"},
             "", kFolderScript);
  })->Iterations(1);
  struct Case {
    const char* name;
    const char* projection;
    Extent eye;
    bool is_toed_in = false;
  };
  for (const Case& each : {Case{"lat-long", "lat-long", {4096, 2048}}, Case{"toe-in", "lat-long", {4096, 2048}, true},
                           Case{"cube", "cube-3x2", {3072, 2048}}, Case{"eac", "eac", {3072, 2048}},
                           Case{"vr180", "vr180", {2048, 2048}}, Case{"fisheye", "fisheye", {2048, 2048}}}) {
    benchmark::RegisterBenchmark(
        (std::string("frame/") + each.name).c_str(),
        [each](benchmark::State& state) { frame(state, each.projection, each.eye, each.is_toed_in); })
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
  }
  return true;
}();

}  // namespace

BENCHMARK_MAIN();
