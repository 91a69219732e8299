// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/stitch.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>

#include "ods/base/checksum.h"
#include "ods/base/error.h"
#include "ods/files/scratch.h"
#include "ods/stitch/view.h"

namespace ods {

namespace {

// The views of one slit of an eye, from the top; empty if one is at fault.
using Slit = std::vector<std::shared_ptr<const View>>;

// The columns of a batch that a slit contributes to, and its weight in each.
struct Part {
  int place;  // index along the picture, before wrapping around
  int left;
  std::vector<float> weights;
  std::vector<float> channel_weights;  // the weights per channel; 0 for channels that are never averaged
};

// Columns of an eye in the journal, stored row-major, so that writes are sequential.
struct Strip {
  size_t first_pixel;  // counted over both eyes
  int left;            // columns past the right edge wrap around
  int right;           // one past the last

  size_t pixel(int y) const { return first_pixel + static_cast<size_t>(y) * static_cast<size_t>(right - left); }
};

// Columns that are filled at once, each range from the centre of a slit to that of the next.
struct Batch {
  size_t index;  // counted over both eyes
  int first;
  int last;  // one past the last
  Strip strip;
  std::vector<Part> parts;
};

// Weighted sums of the views over a part of a row.
struct RowSums {
  int left = 0;
  int right = 0;
  std::vector<float> sums;     // per pixel and channel
  std::vector<float> whole;    // per pixel: the sum of the views' weights
  std::vector<float> maximum;  // per pixel: the largest weight; its view gives the channels that are not averaged

  void start(int from, int to, size_t channels) {
    const size_t count = static_cast<size_t>(to - from);
    left = from, right = to;
    sums.assign(count * channels, 0.0f), whole.assign(count, 0.0f), maximum.assign(count, 0.0f);
  }
};

// The start of a journal. After it come the marks, one per batch, then pixels, ordered by eye, batch,
// row, pixel, channel.
constexpr std::string_view kMark = "omnistereo stitching journal\n";
struct JournalHead {
  char mark[32];
  uint64_t key;
};

// The checksum covers the batch's pixels, the key and `done`: after a power loss, marks may have reached the disk
// before their pixels, and a new key before old marks were cleared.
struct BatchMark {
  int64_t done;  // 0, or 1 + the batch's number of unseen pixels
  uint64_t checksum;
};

class Stitcher {
 public:
  Stitcher(const SlitRig& rig, const OpenView& open) : rig_(rig), open_(open) {}
  void choose_layers(const StitchOptions& options);
  void make_eye(size_t eye, const std::function<void(int slit)>& done);
  Stitched finish();

 private:
  std::vector<Batch> batches_of(size_t eye) const;
  JournalHead& head() const { return *reinterpret_cast<JournalHead*>(picture_->data()); }
  BatchMark& mark_of(const Batch& batch) const {
    return reinterpret_cast<BatchMark*>(picture_->data() + sizeof(JournalHead))[batch.index];
  }
  uint32_t checksum_of(const Batch& batch, int64_t done) const;
  float* pixels() const { return reinterpret_cast<float*>(picture_->data() + pixels_from_); }
  bool was_done(const Batch& batch);
  void set_done(const Batch& batch);
  int slit_of(int place) const;
  int slits_at_once() const;
  std::map<int, Slit> open_slits(size_t eye, int first, int last, const std::map<int, Slit>& open);
  std::shared_ptr<const View> open_view(size_t index);
  std::vector<Part> parts_of(const Batch& batch) const;
  void fill_row(const SlitRows& rows, const std::map<int, Slit>& slits, const Batch& batch, int y);
  void add_part(const Part& part, const float* seen, float share, RowSums& row) const;
  float slit_weight(int place, int x) const;
  float pitch_weight(int pitch, int y) const;
  float place_of(int x) const;
  int column_at(double place) const;

  const SlitRig& rig_;
  const OpenView& open_;
  LayerSet layers_;                      // shared by all views
  std::optional<StoredPicture> sample_;  // the view from which it was read
  size_t sample_index_ = 0;
  std::vector<std::vector<Batch>> batches_;  // per eye
  std::shared_ptr<Scratch> picture_;         // a journal file, or memory
  size_t pixels_from_ = 0;                   // bytes
  std::mutex mutex_;
  std::vector<ViewFault> faults_;
  std::atomic<int64_t> unseen_{0};  // count of the current batch
  int64_t unseen_all_ = 0;
};

// A picture up to this many bytes stays in memory: evicting it would only cost page faults.
constexpr size_t kMaxResident = size_t{256} << 20;

// --- views ----------------------------------------------------------------------------------------------------------

bool is_views_fault(const Error& error) {
  return error.kind() == ErrorKind::kInput;
}

// The first readable view determines the layers.
void Stitcher::choose_layers(const StitchOptions& options) {
  std::string fault;
  for (size_t i = 0; i < rig_.views.size() && !sample_; i++) {
    try {
      sample_ = open_(i);
      sample_index_ = i;
    } catch (const Error& error) {
      if (!is_views_fault(error)) throw;
      if (fault.empty()) fault = error.what();
    }
  }
  if (!sample_)
    throw Error(ErrorKind::kInput, fmt::format("none of the {} views can be read: {}", rig_.views.size(), fault));
  layers_ = layers_of(*sample_);
  for (size_t eye = 0; eye < rig_.eyes.size(); eye++) batches_.push_back(batches_of(eye));
  const size_t batches = rig_.eyes.size() * batches_[0].size();
  pixels_from_ = (sizeof(JournalHead) + sizeof(BatchMark) * batches + 4095) / 4096 * 4096;
  const size_t pixels = rig_.eyes.size() * static_cast<size_t>(rig_.eye.width) * static_cast<size_t>(rig_.eye.height);
  const size_t size = pixels_from_ + pixels * layers_.channels * sizeof(float);
  if (options.journal.empty()) {
    picture_ = std::make_shared<Scratch>(size, "", 0);
    return;
  }
  picture_ = std::make_shared<Scratch>(size, options.journal, kMark);
  constexpr uint64_t kJournalVersion = 3;  // changes with the layout of pixels; other versions are not resumed
  const uint64_t key = options.journal_key + kJournalVersion;
  if (head().key != key) {
    std::memset(picture_->data() + sizeof(JournalHead), 0, pixels_from_ - sizeof(JournalHead));
    head().key = key;
  }
}

std::vector<Batch> Stitcher::batches_of(size_t eye) const {
  const int first = goes_round(rig_) ? 0 : -1, end = rig_.options.slits, step = slits_at_once();
  const auto edge = [&](int place) {
    return goes_round(rig_) ? column_at(place) : std::clamp(column_at(place), 0, rig_.eye.width);
  };
  const size_t height = static_cast<size_t>(rig_.eye.height);
  size_t pixels = eye * static_cast<size_t>(rig_.eye.width) * height;
  std::vector<Batch> batches;
  for (int place = first; place < end; place += step) {
    const int stop = std::min(place + step, end);
    Batch& batch = batches.emplace_back(Batch{0, place, stop, {pixels, edge(place), edge(stop)}, {}});
    pixels += static_cast<size_t>(batch.strip.right - batch.strip.left) * height;
    batch.parts = parts_of(batch);
  }
  for (size_t i = 0; i < batches.size(); i++) batches[i].index = eye * batches.size() + i;
  return batches;
}

uint32_t Stitcher::checksum_of(const Batch& batch, int64_t done) const {
  const Strip& strip = batch.strip;
  const std::span<const float> batch_pixels(pixels() + strip.pixel(0) * layers_.channels,
                                            (strip.pixel(rig_.eye.height) - strip.pixel(0)) * layers_.channels);
  const int64_t facts[] = {done, static_cast<int64_t>(head().key)};
  return crc32(std::as_bytes(batch_pixels), crc32(std::as_bytes(std::span(facts))));
}

bool Stitcher::was_done(const Batch& batch) {
  const BatchMark& mark = mark_of(batch);
  if (mark.done <= 0 || mark.checksum != checksum_of(batch, mark.done)) return false;
  unseen_all_ += mark.done - 1;
  return true;
}

// A batch with faulty views is repeated by the next run.
void Stitcher::set_done(const Batch& batch) {
  unseen_all_ += unseen_;
  if (!faults_.empty() || !picture_->on_disk()) return;
  const int64_t done = 1 + unseen_;
  mark_of(batch) = {done, checksum_of(batch, done)};
}

std::shared_ptr<const View> Stitcher::open_view(size_t index) {
  try {
    StoredPicture picture = sample_ && index == sample_index_ ? *sample_ : open_(index);
    if (picture.size.width != rig_.view.width || picture.size.height != rig_.view.height) {
      throw Error(ErrorKind::kInput, fmt::format("it is {}x{}, not {}x{}", picture.size.width, picture.size.height,
                                                 rig_.view.width, rig_.view.height));
    }
    if (!same_layers(layers_of(picture), layers_))
      throw Error(ErrorKind::kInput, "its layers differ from those of the other views");
    return std::make_shared<const View>(std::move(picture), rig_.views[index], rig_.options.depth);
  } catch (const Error& error) {
    if (!is_views_fault(error)) throw;
    const std::lock_guard lock(mutex_);
    faults_.push_back({index, error.what()});
    return nullptr;
  }
}

// The slit at an index along the picture, which may be past its edges.
int Stitcher::slit_of(int place) const {
  const int slits = rig_.options.slits;
  return goes_round(rig_) ? (place + slits) % slits : std::clamp(place, 0, slits - 1);
}

// The slits of a range, reusing those that are already open.
std::map<int, Slit> Stitcher::open_slits(size_t eye, int first, int last, const std::map<int, Slit>& open) {
  std::map<int, Slit> slits;
  std::vector<std::pair<int, int>> wanted;  // slit, pitch
  for (int place = first; place <= last; place++) {
    const int slit = slit_of(place);
    if (slits.contains(slit)) continue;
    const auto found = open.find(slit);
    slits[slit] = found != open.end() ? found->second : Slit(static_cast<size_t>(rig_.options.pitches));
    for (int pitch = 0; pitch < rig_.options.pitches && found == open.end(); pitch++) wanted.emplace_back(slit, pitch);
  }
  tbb::parallel_for(size_t{0}, wanted.size(), [&](size_t i) {
    const auto [slit, pitch] = wanted[i];
    slits.at(slit)[static_cast<size_t>(pitch)] = open_view(view_index(rig_, eye, slit, pitch));
  });
  return slits;
}

int Stitcher::slits_at_once() const {
  const size_t view = static_cast<size_t>(rig_.view.width) * static_cast<size_t>(rig_.view.height) * layers_.channels;
  const size_t slit = view * sizeof(float) * static_cast<size_t>(rig_.options.pitches);
  return static_cast<int>(std::clamp<size_t>((size_t{64} << 20) / slit, 1, 16));
}

// --- pixels ----------------------------------------------------------------------------------------------------------

// The weight of a slit or pitch at a distance from its centre, in units of their spacing, when they fade over `blend`.
// A point exactly on a border belongs to both sides, so that it always belongs to at least one.
float weight_at(float distance, float blend) {
  constexpr float kSharpest = 1e-4f;
  return std::clamp((0.5f - distance) / std::max(blend, kSharpest) + 0.5f, 0.0f, 1.0f);
}

// A column's position, in slits from the centre of the first.
float Stitcher::place_of(int x) const {
  return static_cast<float>((x + 0.5) * rig_.options.slits / rig_.eye.width - 0.5);
}

// The first column at or after a position.
int Stitcher::column_at(double place) const {
  return static_cast<int>(std::ceil((place + 0.5) * rig_.eye.width / rig_.options.slits - 0.5));
}

float Stitcher::slit_weight(int place, int x) const {
  const float beyond = place_of(x) - static_cast<float>(place);
  const bool outermost = !goes_round(rig_) && (beyond < 0.0f ? place == 0 : place == rig_.options.slits - 1);
  return outermost ? 1.0f : weight_at(std::abs(beyond), rig_.options.blend);
}

float Stitcher::pitch_weight(int pitch, int y) const {
  const float top = pitch_border(rig_, -1), bottom = pitch_border(rig_, rig_.options.pitches - 1);
  const float latitude = mix(top, bottom, (static_cast<float>(y) + 0.5f) / static_cast<float>(rig_.eye.height));
  const float beyond = (pitch_latitude(rig_, pitch) - latitude) / pitch_height(rig_);
  const bool outermost = beyond < 0.0f ? pitch == 0 : pitch == rig_.options.pitches - 1;
  return outermost ? 1.0f : weight_at(std::abs(beyond), 2.0f * pitch_fade(rig_) / pitch_height(rig_));
}

std::vector<Part> Stitcher::parts_of(const Batch& batch) const {
  const double reach = 0.5 * (1.0 + static_cast<double>(rig_.options.blend));
  std::vector<Part> parts;
  for (int place = batch.first; place <= batch.last; place++) {
    if (!goes_round(rig_) && slit_of(place) != place) continue;
    Part part{place, std::max(batch.strip.left, column_at(place - reach)), {}, {}};
    int right = std::min(batch.strip.right, column_at(place + reach));
    if (!goes_round(rig_) && place == 0) part.left = batch.strip.left;
    if (!goes_round(rig_) && place == rig_.options.slits - 1) right = batch.strip.right;
    for (int x = part.left; x < right; x++) {
      part.weights.push_back(slit_weight(place, x));
      for (const char nearest : layers_.is_nearest) {
        part.channel_weights.push_back(nearest ? 0.0f : part.weights.back());
      }
    }
    if (!part.weights.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

// Adds one view's contribution to a row of a batch.
void Stitcher::add_part(const Part& part, const float* seen, float share, RowSums& row) const {
  const size_t channels = layers_.channels, from = static_cast<size_t>(part.left - row.left);
  float *sums = &row.sums[from * channels], *whole = &row.whole[from], *maximum = &row.maximum[from];
  for (size_t i = 0; i < part.channel_weights.size(); i++) sums[i] += share * part.channel_weights[i] * seen[i];
  for (size_t i = 0; i < part.weights.size(); i++) whole[i] += share * part.weights[i];
  if (layers_.first_nearest == channels) return;
  for (const float in_slit : part.weights) {
    for (size_t c = layers_.first_nearest; c < channels; c++) {
      if (layers_.is_nearest[c] && share * in_slit > *maximum) sums[c] = seen[c];
    }
    *maximum = std::max(*maximum, share * in_slit), maximum++;
    seen += channels, sums += channels;
  }
}

void Stitcher::fill_row(const SlitRows& rows, const std::map<int, Slit>& slits, const Batch& batch, int y) {
  const size_t channels = layers_.channels;
  thread_local RowSums row;
  thread_local std::vector<float> seen;
  row.start(batch.strip.left, batch.strip.right, channels);
  int unseen = 0;
  for (int pitch = 0; pitch < rig_.options.pitches; pitch++) {
    const float share = pitch_weight(pitch, y);
    if (share <= 0.0f) continue;
    for (const Part& part : batch.parts) {
      const int slit = slit_of(part.place);
      const View* view = slits.at(slit)[static_cast<size_t>(pitch)].get();
      if (!view) continue;
      seen.resize(part.channel_weights.size());
      unseen += view->fill(rows.rays(), rows.row(part.place, slit, pitch, y), y, part.left, seen);
      add_part(part, seen.data(), share, row);
    }
  }
  unseen_ += unseen;
  const float* sums = row.sums.data();
  float* pixel = pixels() + batch.strip.pixel(y) * channels;
  for (const float whole : row.whole) {
    const float scale = whole > 0.0f ? 1.0f / whole : 1.0f;
    for (size_t c = 0; c < channels; c++) pixel[c] = sums[c] * (layers_.is_nearest[c] ? 1.0f : scale);
    sums += channels, pixel += channels;
  }
}

// Fills the range from one slit's centre to the next while the next views are read.
void Stitcher::make_eye(size_t eye, const std::function<void(int slit)>& done) {
  std::vector<Batch> batches = batches_[eye];
  batches.erase(std::remove_if(batches.begin(), batches.end(), [&](const Batch& batch) { return was_done(batch); }),
                batches.end());
  if (batches.empty()) return;
  const SlitRows rows(rig_, eye);
  std::map<int, Slit> slits = open_slits(eye, batches.front().first, batches.front().last, {});
  const std::map<int, Slit> start(slits.begin(), std::next(slits.begin()));  // also adjacent to the last one
  for (size_t i = 0; i < batches.size(); i++) {
    std::map<int, Slit> open = slits, next;
    open.insert(start.begin(), start.end());
    tbb::task_group ahead;
    ahead.run([&] {
      if (i + 1 < batches.size()) next = open_slits(eye, batches[i + 1].first, batches[i + 1].last, open);
    });
    unseen_ = 0;
    tbb::parallel_for(0, rig_.eye.height, [&](int y) { fill_row(rows, slits, batches[i], y); });
    ahead.wait();
    set_done(batches[i]);
    slits = std::move(next);
    if (picture_->size() > kMaxResident) picture_->release();
    if (done) done(batches[i].last);
  }
}

Stitched Stitcher::finish() {
  Stitched made;
  made.rows.eye = rig_.eye;
  made.rows.eyes = rig_.eyes;
  made.rows.layers = layers_.layers;
  std::vector<std::vector<Strip>> strips(rig_.eyes.size());
  for (size_t eye = 0; eye < strips.size(); eye++) {
    for (const Batch& batch : batches_[eye]) strips[eye].push_back(batch.strip);
  }
  made.rows.fill = [picture = picture_, pixels = pixels(), channels = layers_.channels, width = rig_.eye.width, strips](
                       int index, int y, std::span<float> row) {
    for (const Strip& strip : strips[static_cast<size_t>(index)]) {
      const int column = strip.left % width, count = strip.right - strip.left;
      const size_t fits = static_cast<size_t>(std::min(count, width - column)) * channels;
      const float *from = pixels + strip.pixel(y) * channels, *end = from + static_cast<size_t>(count) * channels;
      std::copy(from, from + fits, &row[static_cast<size_t>(column) * channels]);
      std::copy(from + fits, end, row.begin());
    }
  };
  made.rows.band_done = [picture = picture_] { picture->release(); };
  std::sort(faults_.begin(), faults_.end(), [](const auto& a, const auto& b) { return a.view < b.view; });
  made.faults = std::move(faults_);
  made.unseen = unseen_all_;
  return made;
}

}  // namespace

Stitched stitch(const SlitRig& rig, const OpenView& open, const StitchOptions& options,
                const std::function<void(double part)>& done) {
  Stitcher stitcher(rig, open);
  stitcher.choose_layers(options);
  const double all = static_cast<double>(rig.eyes.size()) * rig.options.slits;
  for (size_t eye = 0; eye < rig.eyes.size(); eye++) {
    stitcher.make_eye(eye, [&](int slit) {
      if (done) done((static_cast<double>(eye) * rig.options.slits + slit) / all);
    });
  }
  return stitcher.finish();
}

}  // namespace ods
