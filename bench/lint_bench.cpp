// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Detection rate and false positives of ods lint: faults of many strengths planted into pictures of many scenes, sizes
// and JPEG qualities, and as many kinds of correct pictures. Prints the tables of docs/lint.md.
// "Found": the report names that fault, with a certainty of at least 0.5.
//
//   lint_bench           every fault at every strength, few sizes and qualities
//   lint_bench --full    all of them, as in docs/lint.md
//   lint_bench --only NAME    only the rows whose names and strengths contain this; may be given several times
//   lint_bench --pictures FOLDER    keeps the rendered scenes there for the next run
//   lint_bench --others FOLDER      judges the pictures there (bench/lint_others.sh), which are correct, not ours
//   lint_bench --verbose      a line for every picture that was not judged as expected
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdio>
#include <mutex>
#include <numbers>
#include <random>

#include "bench/lint_pictures.h"
#include "bench/measure.h"
#include "ods/lint/lint.h"

namespace {

struct Wanted {
  bool full = false;
  bool verbose = false;
  std::vector<std::string> only;  // parts of names; empty for all
  std::string pictures;
  std::string others;
};

bool is_wanted(const Wanted& wanted, const PicturePlant& plant, double strength) {
  const std::string name = fmt::format("{} {:g}", plant.name, strength);
  const auto in_name = [&](const std::string& only) { return name.find(only) != std::string::npos; };
  return wanted.only.empty() || std::any_of(wanted.only.begin(), wanted.only.end(), in_name);
}

// A picture to judge: a pair of eyes, its modifications, and its file format.
struct Case {
  const Pair* pair;
  const PicturePlant* plant;
  double strength = 0.0;
  int width = 1024;
  int quality = 90;
};

Verdict judge(const Case& each, const std::string& stem) {
  Made made = make_pair(*each.pair, each.width, each.quality);
  made.seed = static_cast<uint32_t>(std::hash<std::string>()(stem));
  each.plant->plant(made, each.strength);
  const std::string path = save(made, stem);
  const ods::LintReport report = ods::lint(path, made.lint);
  std::filesystem::remove(path);
  return verdict_of(report, each.plant->check,
                    [&](const ods::Finding& finding) { return each.plant->explains(finding); });
}

std::vector<Verdict> judge_all(const std::vector<Case>& cases, const Folder& folder, const Wanted& wanted) {
  std::vector<Verdict> verdicts(cases.size());
  std::mutex speaks;
  tbb::parallel_for(size_t{0}, cases.size(), [&](size_t i) {
    const Case& each = cases[i];
    const std::string name = fmt::format("{}-{}-{}-{}-{}-q{}", i, each.pair->name, each.plant->name, each.strength,
                                         each.width, each.quality);
    verdicts[i] = judge(each, folder.path(name));
    if (!wanted.verbose || verdicts[i].is_expected(each.plant->faults.empty())) return;
    const std::lock_guard<std::mutex> lock(speaks);
    std::fprintf(stderr, "%s%s%s\n", name.c_str(), verdicts[i].judged ? "" : " (not judged)", verdicts[i].text.c_str());
  });
  return verdicts;
}

std::vector<Case> cases_of(const std::vector<Pair>& pairs, const PicturePlant& plant, double strength, bool full) {
  const std::vector<int> widths = full ? std::vector{1024, 1536, 2048} : std::vector{1024};
  const std::vector<int> qualities = full ? std::vector{60, 85, 95} : std::vector{85};
  std::vector<Case> cases;
  for (const Pair& pair : pairs) {
    for (size_t i = 0; i < widths.size(); i++) cases.push_back({&pair, &plant, strength, widths[i], qualities[i]});
  }
  return cases;
}

void print_found(const std::vector<Pair>& pairs, const Folder& folder, const Wanted& wanted) {
  fmt::print(
      "| fault | strength | pictures | found | missed | not judged | other faults told |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const PicturePlant& plant : planted_faults()) {
    for (const double strength : plant.strengths) {
      if (!is_wanted(wanted, plant, strength)) continue;
      const std::vector<Verdict> verdicts = judge_all(cases_of(pairs, plant, strength, wanted.full), folder, wanted);
      int found = 0, unjudged = 0, others = 0;
      for (const Verdict& verdict : verdicts) {
        found += verdict.found ? 1 : 0;
        unjudged += verdict.found || verdict.judged ? 0 : 1;
        others += verdict.others;
      }
      const int all = static_cast<int>(verdicts.size());
      fmt::print("| {} | {:g} {} | {} | {:.1f} % | {} | {} | {} |\n", plant.name, strength, plant.unit, all,
                 100.0 * found / all, all - found - unjudged, unjudged, others);
      std::fflush(stdout);
    }
  }
}

void print_false(const std::vector<Pair>& pairs, const Folder& folder, const Wanted& wanted) {
  fmt::print("\n| correct pictures | pictures | with a false fault |\n|---|---|---|\n");
  int all = 0, wrong = 0;
  for (const PicturePlant& plant : correct_kinds()) {
    std::vector<Case> cases;
    for (const double strength : plant.strengths) {
      if (!is_wanted(wanted, plant, strength)) continue;
      for (const Case& each : cases_of(pairs, plant, strength, wanted.full)) cases.push_back(each);
    }
    if (cases.empty()) continue;
    int told = 0;
    for (const Verdict& verdict : judge_all(cases, folder, wanted)) told += verdict.others > 0 ? 1 : 0;
    fmt::print("| {} | {} | {} |\n", plant.name, cases.size(), told);
    std::fflush(stdout);
    all += static_cast<int>(cases.size()), wrong += told;
  }
  fmt::print("| all | {} | {} |\n", all, wrong);
}

// Correct pictures by other renderers.
std::vector<Pair> pairs_in(const std::string& folder) {
  std::vector<Pair> pairs;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem();
    if (entry.path().extension() == ".png") pairs.push_back({name, ods::open_picture(entry.path())});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.name < b.name; });
  return pairs;
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  for (int i = 1; i < argc; i++) {
    const std::string word = argv[i];
    wanted.full = wanted.full || word == "--full";
    wanted.verbose = wanted.verbose || word == "--verbose";
    if (word == "--only" && i + 1 < argc) wanted.only.push_back(argv[++i]);
    if (word == "--pictures" && i + 1 < argc) wanted.pictures = argv[++i];
    if (word == "--others" && i + 1 < argc) wanted.others = argv[++i];
  }
  const Folder folder;
  std::vector<Pair> pairs;
  const Seconds rendering = seconds_of([&] {
    if (!wanted.others.empty())
      pairs = pairs_in(wanted.others);
    else
      pairs = scene_pairs(wanted.pictures.empty() ? folder.path() : wanted.pictures);
  });
  fmt::print(stderr, "{} pairs made in {:.0f} s\n", pairs.size(), rendering.wall);
  const Seconds judging = seconds_of([&] {
    print_found(pairs, folder, wanted);
    print_false(pairs, folder, wanted);
  });
  fmt::print(stderr, "judged in {:.0f} s, {:.0f} CPU seconds; at most {:.0f} MB\n", judging.wall, judging.cpu,
             peak_megabytes());
}
