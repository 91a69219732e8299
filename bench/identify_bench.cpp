// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Recognition rate of pictures without metadata: every layout with every projection, in worlds by formula and in
// built-in scenes, as JPEGs of two sizes and qualities (PNGs if eyes alternate), and pictures as other programs make
// them. Prints the tables of docs/identify.md. An argument selects the sources whose name contains it, --others selects
// pictures as other programs make them, -v lists each file that was misread.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>

#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"

namespace {

using namespace ods;

struct Origin {
  std::string name;
  TwoEyes eyes;
};

Image rendered(const Scene& scene, int eye, const ProjectionSetting& projection, Extent size) {
  StereoCamera camera;
  camera.position = default_view(scene).position;
  camera.projection = projection;
  RenderOptions options;
  options.width = size.width, options.height = size.height;
  options.samples = 4, options.bounces = 2;
  options.even_noise = false, options.layers = false;
  options.eyes = eye == kLeft ? Eyes::kLeftEye : Eyes::kRightEye;
  return std::move(render_cpu(scene, camera, options).eyes[0].radiance);
}

std::vector<Origin> all_sources() {
  std::vector<Origin> sources;
  for (const World world : kWorlds) {
    sources.push_back({world_name(world), [world](int eye, const ProjectionSetting& projection, Extent size) {
                         StereoCamera camera;
                         camera.projection = projection;
                         return seen_in(world, camera, eye, size);
                       }});
  }
  for (const char* name : {"room", "toys", "fractal", "mirrors"}) {
    const auto scene = std::make_shared<Scene>(find_builtin(name)->make());
    for (Material& material : scene->materials) material.unlit = 1;  // textures without noise
    sources.push_back({name, [scene](int eye, const ProjectionSetting& projection, Extent size) {
                         return rendered(*scene, eye, projection, size);
                       }});
  }
  return sources;
}

// Each eye of a projection and size is made once.
TwoEyes remembered(const TwoEyes& eyes) {
  const auto made = std::make_shared<std::map<std::string, Image>>();
  return [=](int eye, const ProjectionSetting& projection, Extent size) {
    const std::string key = fmt::format("{} {} {}", eye, projection_name(projection), size.width);
    if (!made->contains(key)) made->emplace(key, eyes(eye, projection, size));
    return made->at(key);
  };
}

using Counts = std::array<int, 5>;  // by Verdict

void print_row(const std::string& name, const Counts& counts) {
  int files = 0;
  for (const int count : counts) files += count;
  const auto part = [&](int verdict) { return 100.0 * counts[static_cast<size_t>(verdict)] / std::max(files, 1); };
  fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", name, files, part(0), part(1), part(2),
             part(3), part(4));
  std::fflush(stdout);
}

void print_head(const char* what) {
  fmt::print(
      "\n| {} | files | sure and right | right, not sure | named | wrong, not sure | sure and wrong "
      "|\n|---|---|---|---|---|---|---|\n",
      what);
}

// A patch over the tripod.
Image with_patch(Image image) {
  for (int y = image.height * 92 / 100; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      for (int c = 0; c < 3; c++) image.at(x, y)[c] = 16 * x / image.width % 2 == 0 ? 0.1f : 0.6f;
    }
  }
  return image;
}

Image with_bars(Image image) {
  const int high = image.height / 20;
  for (int y = 0; y < image.height; y++) {
    if (y < high || y >= image.height - high) std::fill_n(image.at(0, y), 3 * image.width, 0.0f);
  }
  return image;
}

// Six faces in an order that we do not support.
Image of_other_order(const Image& image) {
  Image other = image;
  const int face = image.width / 3;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      std::copy_n(image.at((x + face) % image.width, (y + image.height / 2) % image.height), 3, other.at(x, y));
    }
  }
  return other;
}

class Bench {
 public:
  explicit Bench(bool verbose) : verbose_(verbose) {}

  void run_own(const Origin& source, int pixels, int quality) {
    const std::string form = fmt::format("an eye of {}x{}, quality {}", pixels, pixels / 2, quality);
    const TwoEyes eyes = remembered(source.eyes);
    const std::vector<Truth> truths = all_truths();
    const std::vector<Identity> seen = identities(truths, eyes, pixels, quality);
    for (size_t i = 0; i < truths.size(); i++) {
      const auto verdict = static_cast<size_t>(verdict_on(seen[i], truths[i]));
      by_source_[source.name][verdict]++;
      by_layout_[std::string(truths[i].layout ? layout_name(*truths[i].layout) : "one eye")][verdict]++;
      by_projection_[std::string(projection_name(truths[i].projection))][verdict]++;
      by_form_[form][verdict]++;
      all_[verdict]++;
      if (verbose_ && verdict >= 1) tell(source.name, truths[i], seen[i], verdict);
    }
  }

  void run_others(const Origin& source, int pixels) {
    const TwoEyes eyes = remembered(source.eyes);
    add_others("with a patch below", with_patch, eyes, {"lat-long", "vr180"}, pixels);
    add_others("with black bars", with_bars, eyes, {"lat-long", "vr180"}, pixels);
    add_others("cubes of another order", of_other_order, eyes, {"cube-3x2"}, pixels);
  }

  void print() const {
    for (const auto& [title, table] :
         {std::pair("layout", &by_layout_), std::pair("projection", &by_projection_), std::pair("scene", &by_source_),
          std::pair("file", &by_form_), std::pair("others' files", &others_)}) {
      print_head(title);
      for (const auto& [name, counts] : *table) print_row(name, counts);
    }
    print_head("all but others'");
    print_row("all", all_);
  }

 private:
  std::vector<Identity> identities(const std::vector<Truth>& truths, const TwoEyes& eyes, int pixels, int quality) {
    std::vector<Identity> seen(truths.size());
    for (size_t i = 0; i < truths.size(); i++) {
      write_unknown(path(i, truths[i]), truths[i], eyes, unknown_eye(truths[i].projection, pixels), quality);
    }
    tbb::parallel_for(size_t{0}, truths.size(),
                      [&](size_t i) { seen[i] = identify(open_unknown(path(i, truths[i]))); });
    return seen;
  }

  std::string path(size_t i, const Truth& truth) const { return folder_.path(std::to_string(i) + unknown_name(truth)); }

  void add_others(const std::string& name, const std::function<Image(Image)>& change, const TwoEyes& eyes,
                  std::initializer_list<std::string_view> projections, int pixels) {
    std::vector<Truth> truths;
    for (const Truth& truth : all_truths()) {
      if (std::ranges::count(projections, projection_name(truth.projection)) > 0) truths.push_back(truth);
    }
    const TwoEyes changed = [&](int eye, const ProjectionSetting& projection, Extent size) {
      return change(eyes(eye, projection, size));
    };
    const std::vector<Identity> seen = identities(truths, changed, pixels, 75);
    for (size_t i = 0; i < truths.size(); i++) {
      Verdict own = verdict_on(seen[i], truths[i]);
      // A cube in another order is not among the readings; naming it is the best possible result.
      if (seen[i].has_other_faces && !seen[i].is_sure()) own = Verdict::kNamed;
      const auto verdict = static_cast<size_t>(own);
      others_[name][verdict]++;
      if (verbose_ && verdict >= 3) tell(name, truths[i], seen[i], verdict);
    }
  }

  static void tell(const std::string& source, const Truth& truth, const Identity& identity, size_t verdict) {
    constexpr const char* kVerdicts[] = {"", "right", "named", "WRONG", "SURE AND WRONG"};
    std::string readings;
    for (size_t i = 0; i < std::min<size_t>(identity.readings.size(), 3); i++) {
      readings += fmt::format("; {} {:.3f}", reading_text(identity.readings[i]), identity.readings[i].certainty);
    }
    fmt::print("{}: {}, {}{} ({})\n", kVerdicts[verdict], source, truth_text(truth), readings, identity.reason);
  }

  bool verbose_;
  TemporaryFolder folder_;
  std::map<std::string, Counts> by_layout_, by_projection_, by_source_, by_form_, others_;
  Counts all_{};
};

}  // namespace

int main(int argc, char** argv) {
  std::string only;
  bool verbose = false, only_others = false;
  for (int i = 1; i < argc; i++) {
    const std::string word = argv[i];
    (word == "-v" ? verbose : only_others) |= word == "-v" || word == "--others";
    if (!word.starts_with("-")) only = word;
  }
  Bench bench(verbose);
  for (const Origin& source : all_sources()) {
    if (source.name.find(only) == std::string::npos) continue;
    for (const auto& [pixels, quality] : {std::pair(1024, 90), std::pair(512, 75)}) {
      if (!only_others) bench.run_own(source, pixels, quality);
      bench.run_others(source, pixels);
    }
  }
  bench.print();
}
