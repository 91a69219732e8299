// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/quality.h"

#include <fmt/format.h>

#include <cctype>
#include <vector>

#include "cli/console/console.h"
#include "cli/options/picture_options.h"
#include "cli/render/render_job.h"
#include "ods/render/render_options.h"

namespace {

constexpr QualityPreset kPresets[] = {
    {"draft", 1024, 64, 0.3f, false}, {"preview", 2048, 1024, 0.04f, false}, {"final", 4096, 4096, 0.02f, true}};

// Noise cannot fall to 0; at 10 everything is clean.
float parse_noise(const std::string& word) {
  if (word == "none") return 0.0f;
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= 1e-4f && numbers[0] <= 10.0f) return numbers[0];
  throw UsageError(fmt::format("--noise is a number from 0.0001 to 10, or none, not '{}'", word));
}

// Seconds.
double parse_time_limit(const std::string& word) {
  double unit = 1.0;
  std::string number = word;
  if (!word.empty() && std::isalpha(static_cast<unsigned char>(word.back()))) {
    unit = word.back() == 's' ? 1.0 : word.back() == 'm' ? 60.0 : word.back() == 'h' ? 3600.0 : 0.0;
    number.pop_back();
  }
  const std::vector<float> numbers = parse_numbers(number);
  const double seconds = numbers.size() == 1 ? double{numbers[0]} * unit : 0.0;
  if (seconds > 0.0 && seconds <= 1e7) return seconds;
  throw UsageError(fmt::format("--time-limit is a time above 0, such as 90s, 10m or 1.5h, not '{}'", word));
}

}  // namespace

void add_quality_options(Options& options, RenderJob& job) {
  Quality& quality = job.quality;
  quality.preset = kPresets[1];
  options.group("Quality");
  std::string sizes;
  std::vector<std::string> names;
  for (const QualityPreset& q : kPresets) {
    sizes += fmt::format(", {} {} x {} x {:g}", q.name, q.width, q.samples, q.noise);
    names.emplace_back(q.name);
  }
  options.choice(
      "--quality", names, std::string(quality.preset.name), [&](size_t i) { quality.preset = kPresets[i]; },
      "set width, --samples and --noise together" + sizes);
  options.custom(
      "--noise", "LEVEL|none", "", [&](const std::string& word) { quality.noise = parse_noise(word); },
      "stop sampling parts of the picture below this noise, in Cycles' measure (its default is 0.01). none: every "
      "pixel "
      "gets all samples");
  options.number("--samples", quality.samples, 1, ods::kMaxSamples, "the maximum number of samples per pixel");
  options.custom(
      "--time-limit", "TIME", "", [&](const std::string& word) { job.render.time_limit = parse_time_limit(word); },
      "make the best picture possible in this time, for each frame of a video: 90s, 10m, 1.5h. It depends on the "
      "machine");
  options.choice("--denoise", job.denoise, ods::kDenoiserTable,
                 "remove the remaining noise, in both eyes together; by default for all but .exr and .hdr. An .exr "
                 "keeps the noisy picture as the layer raw. oidn: Intel Open Image Denoise, if it is installed");
  options.number("--bounces", job.render.bounces, 0, 1024, "maximum number of light bounces");
  options.choice("--indirect", quality.indirect, ods::kIndirectTable,
                 "how light over several surfaces is computed: with whole paths, or with paths that end in a light "
                 "cache, many times as fast in rooms. By default cache; path for --quality final, .exr and --part");
  options.choice("--caustics", quality.caustics, ods::kCausticsTable,
                 "how light passes through solid glass and liquids: refracted, found by chance, or straight, as "
                 "through a window. By default straight; path for --quality final");
  options.number("--clamp", job.render.clamp, 0.0f, 1e6f,
                 "limit each sample of indirect light to this, against bright specks; this loses light; 0: no limit");
  options.choice("--filter", job.render.filter, ods::kPixelFilterTable, "pixel filter");
  options.number("--seed", job.render.seed, "random seed; the same seed gives the same picture");
  options.number("--threads", job.render.threads, 0, 1024, "number of threads; 0: all processors");
}

void finish_quality(RenderJob& job) {
  const Quality& quality = job.quality;
  const QualityPreset& preset = quality.preset;
  job.form.usual_width = preset.width;
  job.render.samples = quality.samples.value_or(preset.samples);
  const bool exact = preset.exact || job.part || keeps_light(job.output);
  job.render.indirect = quality.indirect.value_or(exact ? ods::Indirect::kPath : ods::Indirect::kCache);
  job.render.caustics = quality.caustics.value_or(preset.exact ? ods::Caustics::kPath : ods::Caustics::kStraight);
  job.render.noise = quality.noise.value_or(job.part ? 0.0f : preset.noise);
}
