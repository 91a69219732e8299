// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Detection rate and false positives of ods lint for videos: faults planted into short films of six shots, and correct
// films. Prints the tables of docs/lint.md. "Found": the report names that fault with a certainty of at least 0.5, with
// the right number of frames and only in the shot that has it.
//
//   lint_video_bench
//   lint_video_bench --only NAME    only the rows whose names contain this
//   lint_video_bench --verbose      a line for every film that was not judged as expected
//   lint_video_bench --keep FOLDER  keeps the films
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "bench/lint_films.h"
#include "bench/measure.h"
#include "ods/lint/video.h"
#include "ods/video/encode.h"

namespace {

struct Wanted {
  std::string only;
  bool verbose = false;
  std::string keep;
};

// Returns whether the finding matches the planted fault in amount and position.
bool is_right(const FilmPlant& plant, double strength, const Film& film, const ods::Finding& finding) {
  if (!plant.explains(finding)) return false;
  if (plant.evidence && finding.evidence.find(plant.evidence(strength)) == std::string::npos) return false;
  const auto in_shot = [&](double time) {
    return static_cast<int>(time * film.fps + 0.5) / film.length() == plant.shot;
  };
  return plant.shot < 0 || std::all_of(finding.times.begin(), finding.times.end(), in_shot);
}

Verdict judge(const FilmPlant& plant, double strength, const Film& film, const std::string& path) {
  const ods::LintReport report = ods::lint_video(path, {{}, plant.every});
  return verdict_of(report, plant.check,
                    [&](const ods::Finding& finding) { return is_right(plant, strength, film, finding); });
}

struct Counts {
  int films = 0, found = 0, unjudged = 0, others = 0;
};

// A film begins with each of the shots in turn; the shots after it follow.
Counts judge_all(const Shots& shots, const FilmPlant& plant, double strength, const Wanted& wanted,
                 const Folder& folder) {
  Counts counts;
  for (size_t first = 0; first < shots.size(); first++) {
    Film film;
    for (size_t i = 0; i < plant.shots; i++) film.shots.push_back(shots[(first + i) % shots.size()]);
    plant.plant(film, strength);
    const std::string name = fmt::format("{} {:g}, {}", plant.name, strength, shots[first]->name);
    std::string stem = name;
    std::replace(stem.begin(), stem.end(), ' ', '-');
    const std::string path = save(film, wanted.keep.empty() ? folder.path(stem) : wanted.keep + "/" + stem);
    const Verdict verdict = judge(plant, strength, film, path);
    if (wanted.keep.empty()) std::filesystem::remove(path);
    counts.films++;
    counts.found += verdict.found ? 1 : 0;
    counts.unjudged += verdict.found || verdict.judged ? 0 : 1;
    counts.others += verdict.others > 0 ? 1 : 0;
    if (wanted.verbose && !verdict.is_expected(plant.faults.empty())) {
      fmt::print(stderr, "{}{}:{}\n", name, verdict.judged ? "" : " (not judged)", verdict.text);
    }
  }
  return counts;
}

void print_found(const Shots& shots, const Wanted& wanted, const Folder& folder) {
  fmt::print("| fault | strength | films | found | missed | not judged | with other faults told |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const FilmPlant& plant : film_faults()) {
    if (plant.name.find(wanted.only) == std::string::npos) continue;
    for (const double strength : plant.strengths) {
      const Counts counts = judge_all(shots, plant, strength, wanted, folder);
      fmt::print("| {} | {:g} {} | {} | {} | {} | {} | {} |\n", plant.name, strength, plant.unit, counts.films,
                 counts.found, counts.films - counts.found - counts.unjudged, counts.unjudged, counts.others);
      std::fflush(stdout);
    }
  }
}

void print_false(const Shots& shots, const Wanted& wanted, const Folder& folder) {
  fmt::print("\n| correct films | films | with a false fault |\n|---|---|---|\n");
  Counts all;
  for (const FilmPlant& plant : correct_films()) {
    if (plant.name.find(wanted.only) == std::string::npos) continue;
    Counts kind;
    for (const double strength : plant.strengths) {
      const Counts counts = judge_all(shots, plant, strength, wanted, folder);
      kind.films += counts.films, kind.others += counts.others;
    }
    fmt::print("| {} | {} | {} |\n", plant.name, kind.films, kind.others);
    std::fflush(stdout);
    all.films += kind.films, all.others += kind.others;
  }
  fmt::print("| all | {} | {} |\n", all.films, all.others);
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  for (int i = 1; i < argc; i++) {
    const std::string word = argv[i];
    wanted.verbose = wanted.verbose || word == "--verbose";
    if (word == "--only" && i + 1 < argc) wanted.only = argv[++i];
    if (word == "--keep" && i + 1 < argc) wanted.keep = argv[++i];
  }
  if (!ods::has_encoder("libx264")) {
    fmt::print(stderr, "this machine has no libx264\n");
    return 1;
  }
  const Folder folder;
  const Seconds all = seconds_of([&] {
    const Shots shots = film_shots();
    print_found(shots, wanted, folder);
    print_false(shots, wanted, folder);
  });
  fmt::print(stderr, "{:.0f} s, {:.0f} CPU seconds; at most {:.0f} MB\n", all.wall, all.cpu, peak_megabytes());
}
