// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/gpu_passes.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <vector>

#include "ods/render/gpu/shaders.h"

namespace ods {
namespace {

// A card that draws a screen is reset if it computes for two seconds at a time; the screen stutters long before.
constexpr double kSecondsAtOnce = 0.1;
// For each list: the work groups of its stage, in three dimensions, and its length.
using GpuLists = std::array<std::array<uint32_t, 4>, kLists>;

constexpr size_t kChunkBytes = 16;
constexpr int kMaxRounds = 64;  // at once: the last rounds of a piece have little to do
static_assert(3 * kMaxRounds <= GpuDevice::kMaxDispatches);

template <typename T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

}  // namespace

GpuStages make_stages(GpuDevice& device, bool whole) {
  const GpuShaders shaders = gpu_shaders(whole);
  const GpuStages stages{device.make_pipeline(shaders.trace), device.make_pipeline(shaders.begin),
                         device.make_pipeline(shaders.shade)};
  device.store_pipelines();
  return stages;
}

GpuPasses::GpuPasses(GpuDevice& device, const GpuStages& stages, GpuView view, int slots, const RenderOptions& options,
                     PictureSamples& samples)
    : device_(device),
      stages_(stages),
      most_blocks_(std::max(slots / kGroupSize, 1)),
      options_(options),
      samples_(samples),
      planes_(device, samples, view) {
  most_blocks_ = std::min(most_blocks_, total_blocks());
  pass_ = device.make_buffer(samples.noisy.size() * sizeof(GpuBlock));
  view.slot_count = static_cast<uint32_t>(most_blocks_) * kGroupSize;
  slots_ = device.make_buffer(view.slot_count * kChunkBytes * kSlotChunks);
  lists_ = device.make_buffer(sizeof(GpuLists));
  slots_in_lists_ = device.make_buffer(view.slot_count * sizeof(uint32_t) * kLists);
  view.pass = pass_.address, view.slots = slots_.address, view.lists = lists_.address;
  view.slots_in_lists = slots_in_lists_.address;
  view_ = device.make_buffer(sizeof(GpuView));
  device.upload(view_, 0, bytes_of(view));
}

GpuPasses::~GpuPasses() {
  for (const GpuBuffer& buffer : {pass_, slots_, lists_, slots_in_lists_, view_}) device_.free(buffer);
}

// Counts the blocks of both eyes.
int GpuPasses::total_blocks() const {
  return static_cast<int>(samples_.noisy.size() * samples_.eyes.size());
}

bool GpuPasses::render_blocks(const Pass& pass, BlockRange blocks, const Progress& progress, bool whole) {
  upload_pass(pass);
  for (int begin = blocks.begin; begin < blocks.end; begin += most_blocks_) {
    const int end = std::min(begin + most_blocks_, blocks.end);
    if (!render_slots(pass, {begin, end}, progress, whole)) return false;
    if (progress.report) progress.report(static_cast<double>(end) / total_blocks());
  }
  count_samples_of(pass, blocks);
  return true;
}

void GpuPasses::upload_pass(const Pass& pass) {
  std::vector<GpuBlock> table(samples_.noisy.size());
  for (size_t b = 0; b < table.size(); b++) {
    table[b] = {pass.noisy[b], samples_of(pass.plan, b, pass.from), samples_of(pass.plan, b, pass.to),
                block_weight(pass, b)};
  }
  device_.upload(pass_, 0, std::as_bytes(std::span(table)));
}

// Renders blocks that have a slot for each pixel, in rounds until all slots are finished. Returns false if it was
// cancelled.
bool GpuPasses::render_slots(const Pass& pass, BlockRange blocks, const Progress& progress, bool whole) {
  const auto groups = static_cast<uint32_t>(blocks.end - blocks.begin);
  device_.clear(slots_, size_t{groups} * kGroupSize * kChunkBytes);  // the first chunk of each
  GpuRound round{};
  round.view = view_.address;
  round.first_block = blocks.begin;
  round.is_reversed = options_.last_tile_first ? 1 : 0;
  round.takes_depth = is_first(pass, options_) ? 1 : 0;
  round.is_first = 1;
  const GpuLists empty = [] {
    GpuLists lists;
    lists.fill({1, 1, 1, 0});
    return lists;
  }();
  device_.upload(lists_, 0, bytes_of(empty));
  while (round.is_first == 1 || is_busy(round)) {
    if (!whole && progress.cancelled && progress.cancelled()) return false;
    run_rounds(round, groups);
  }
  return true;
}

// Returns whether slots wait for the next round.
bool GpuPasses::is_busy(const GpuRound& round) {
  GpuLists lists;
  device_.download(lists_, 0, std::as_writable_bytes(std::span(lists)));
  const auto length = [&](int list) { return lists[static_cast<size_t>(list + round.parity)][3]; };
  return length(kBeginLists) > 0 || length(kTraceLists) > 0;
}

// Runs several rounds, and adapts their number to the time that they took.
void GpuPasses::run_rounds(GpuRound& round, uint32_t groups) {
  std::vector<GpuRound> rounds(static_cast<size_t>(rounds_));
  std::vector<GpuDispatch> dispatches;
  for (GpuRound& each : rounds) {
    each = round;
    const auto list_at = [&](int lists) {
      return static_cast<size_t>(lists + round.parity) * sizeof(GpuLists::value_type);
    };
    dispatches.push_back(
        {stages_.begin, bytes_of(each), round.is_first == 1 ? groups : 0, lists_, list_at(kBeginLists)});
    dispatches.push_back({stages_.trace, bytes_of(each), 0, lists_, list_at(kTraceLists)});
    dispatches.push_back({stages_.shade, bytes_of(each), 0, lists_, list_at(kShadeLists)});
    round.is_first = 0;
    round.parity = 1 - round.parity;
  }
  const auto began = std::chrono::steady_clock::now();
  const std::vector<double> seconds = device_.run(dispatches);
  for (size_t i = 0; i < seconds.size(); i += 3) {
    times_.begin += seconds[i], times_.trace += seconds[i + 1], times_.shade += seconds[i + 2];
  }
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  rounds_ = std::clamp(static_cast<int>(rounds_ * kSecondsAtOnce / took), 1, std::min(2 * rounds_, kMaxRounds));
}

void GpuPasses::count_samples_of(const Pass& pass, BlockRange blocks) {
  const int per_eye = static_cast<int>(samples_.noisy.size());
  for (int i = blocks.begin; i < blocks.end; i++) {
    const int work = options_.last_tile_first ? total_blocks() - 1 - i : i;
    const auto b = static_cast<size_t>(work % per_eye);
    const int added = samples_of(pass.plan, b, pass.to) - samples_of(pass.plan, b, pass.from);
    std::vector<uint32_t>& count = samples_.eyes[static_cast<size_t>(work / per_eye)].count;
    const int x0 = work % per_eye % pass.plan.columns * kBlockSize;
    const int y0 = work % per_eye / pass.plan.columns * kBlockSize;
    for (int y = y0; y < std::min(y0 + kBlockSize, options_.height); y++) {
      for (int x = x0; x < std::min(x0 + kBlockSize, options_.width); x++) {
        const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(options_.width) + static_cast<size_t>(x);
        if (is_noisy(pass, b, x, y)) count[pixel] += static_cast<uint32_t>(added);
      }
    }
  }
}

}  // namespace ods
