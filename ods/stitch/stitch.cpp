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

#include "ods/base/error.h"
#include "ods/base/scratch.h"
#include "ods/stitch/view.h"

namespace ods {

namespace {

// --- what a pixel is put together of
// -----------------------------------------------------------------------------------

// Two neighbours, and how much the second one counts.
struct Fade {
  int first = 0;
  int second = 0;
  float part = 0.0f;
};

// `at`: 0 in the middle of the first of `count`, 1 in that of the second. `width`: of the fade between two, of 1.
Fade fade_at(float at, int count, float width) {
  const int before = static_cast<int>(std::floor(at));
  const float beyond = at - static_cast<float>(before) - 0.5f;
  const float part = width > 0.0f ? std::clamp(beyond / width + 0.5f, 0.0f, 1.0f) : beyond < 0.0f ? 0.0f : 1.0f;
  return {std::clamp(before, 0, count - 1), std::clamp(before + 1, 0, count - 1), part};
}

// Where a pixel looks from its place on the circle, and the pixels beside and below it.
struct Pixel {
  Ray ray;
  vec3 right;
  vec3 down;
};

// The views of one slit of an eye, from the top; none where one is at fault.
using Slit = std::vector<std::shared_ptr<const View>>;

// Places along the picture that are filled at once, each from the middle of a slit to that of the next one.
struct Batch {
  size_t index;  // of both eyes' batches
  int first;
  int last;  // one behind
  std::vector<int> columns;
};

class Stitcher {
 public:
  Stitcher(const SlitRig& rig, const OpenView& open) : rig_(rig), open_(open), camera_(make_camera(rig.camera)) {}
  void choose_form(const StitchOptions& options);
  void make_eye(size_t eye, const std::function<void(int slit)>& done);
  Stitched finish();

 private:
  std::vector<Batch> batches_of(size_t eye) const;
  int64_t* done_of(size_t batch) const { return reinterpret_cast<int64_t*>(picture_->data()) + 1 + batch; }
  bool was_done(const Batch& batch);
  void set_done(const Batch& batch);
  int slit_of(int place) const;
  int slits_at_once() const;
  std::map<int, Slit> open_slits(size_t eye, int first, int last, const std::map<int, Slit>& open);
  std::shared_ptr<const View> open_view(size_t index);
  void fill_row(size_t eye, const std::map<int, Slit>& slits, const std::vector<int>& columns, int y);
  void fill_pixel(const Pixel& pixel, const Fade& down, const Slit* const (&slits)[2], float part, float* out);
  Pixel pixel_at(size_t eye, int x, int y) const;
  float slit_at(int x) const;

  const SlitRig& rig_;
  const OpenView& open_;
  Camera camera_;
  ViewForm form_;                        // what all views have
  std::optional<StoredPicture> sample_;  // the view that told it
  size_t sample_index_ = 0;
  // A key; of every batch, once it is done, 1 + its pixels that are unseen; then eyes, rows, pixels, channels.
  std::shared_ptr<Scratch> picture_;
  size_t pixels_from_ = 0;  // bytes
  std::mutex mutex_;
  std::vector<ViewFault> faults_;
  std::atomic<int64_t> unseen_{0};  // pixels of the batch
  int64_t unseen_all_ = 0;
};

// --- views ----------------------------------------------------------------------------------------------------------

bool is_views_fault(const Error& error) {
  return error.kind() == ErrorKind::kInput;
}

// The first view that can be read tells what all of them have.
void Stitcher::choose_form(const StitchOptions& options) {
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
  form_ = form_of(*sample_);
  const size_t batches = rig_.eyes.size() * batches_of(0).size();
  pixels_from_ = (sizeof(int64_t) * (1 + batches) + 4095) / 4096 * 4096;
  const size_t pixels = rig_.eyes.size() * static_cast<size_t>(rig_.eye.width) * static_cast<size_t>(rig_.eye.height);
  const size_t size = pixels_from_ + pixels * form_.channels * sizeof(float);
  if (options.journal.empty()) {
    picture_ = std::make_shared<Scratch>(size, options.scratch_folder, options.most_in_memory);
    return;
  }
  picture_ = std::make_shared<Scratch>(size, options.journal);
  uint64_t& key = *reinterpret_cast<uint64_t*>(picture_->data());
  if (key != options.journal_key) std::memset(picture_->data(), 0, size);
  key = options.journal_key;
}

std::vector<Batch> Stitcher::batches_of(size_t eye) const {
  const int first = goes_round(rig_) ? 0 : -1, end = rig_.options.slits, step = slits_at_once();
  std::vector<Batch> batches;
  for (int place = first; place < end; place += step) batches.push_back({0, place, std::min(place + step, end), {}});
  for (size_t i = 0; i < batches.size(); i++) batches[i].index = eye * batches.size() + i;
  return batches;
}

bool Stitcher::was_done(const Batch& batch) {
  const int64_t done = *done_of(batch.index);
  unseen_all_ += std::max<int64_t>(done - 1, 0);
  return done > 0;
}

// One with views at fault is done again by who comes after us.
void Stitcher::set_done(const Batch& batch) {
  unseen_all_ += unseen_;
  if (faults_.empty()) *done_of(batch.index) = 1 + unseen_;
}

std::shared_ptr<const View> Stitcher::open_view(size_t index) {
  try {
    StoredPicture picture = sample_ && index == sample_index_ ? *sample_ : open_(index);
    if (picture.size.width != rig_.view.width || picture.size.height != rig_.view.height) {
      throw Error(ErrorKind::kInput, fmt::format("it is {}x{}, not {}x{}", picture.size.width, picture.size.height,
                                                 rig_.view.width, rig_.view.height));
    }
    if (!same_layers(form_of(picture), form_)) throw Error(ErrorKind::kInput, "its layers are not those of the others");
    return std::make_shared<const View>(std::move(picture), rig_.views[index], rig_.options.depth);
  } catch (const Error& error) {
    if (!is_views_fault(error)) throw;
    const std::lock_guard lock(mutex_);
    faults_.push_back({index, error.what()});
    return nullptr;
  }
}

// The slit at a place along the picture, which may lie beyond its edges.
int Stitcher::slit_of(int place) const {
  const int slits = rig_.options.slits;
  return goes_round(rig_) ? (place + slits) % slits : std::clamp(place, 0, slits - 1);
}

// Those of a range of places, of which some are open already.
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
  const size_t view = static_cast<size_t>(rig_.view.width) * static_cast<size_t>(rig_.view.height) * form_.channels;
  const size_t slit = view * sizeof(float) * static_cast<size_t>(rig_.options.pitches);
  return static_cast<int>(std::clamp<size_t>((size_t{64} << 20) / slit, 1, 16));
}

// --- pixels ---------------------------------------------------------------------------------------------------------

Pixel Stitcher::pixel_at(size_t eye, int x, int y) const {
  const vec2 size(static_cast<float>(rig_.eye.width), static_cast<float>(rig_.eye.height));
  const vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const int which = rig_.eyes[eye];
  return {camera_ray(camera_, which, middle / size),
          camera_ray(camera_, which, (middle + vec2(1.0f, 0.0f)) / size).direction,
          camera_ray(camera_, which, (middle + vec2(0.0f, 1.0f)) / size).direction};
}

// In slits, from the middle of the first; with slits all round, from 0 on.
float Stitcher::slit_at(int x) const {
  const double slits = rig_.options.slits;
  const double at = (x + 0.5) * slits / rig_.eye.width - 0.5;
  return static_cast<float>(at < 0.0 && goes_round(rig_) ? at + slits : at);
}

void Stitcher::fill_pixel(const Pixel& pixel, const Fade& down, const Slit* const (&slits)[2], float part, float* out) {
  thread_local std::vector<float> seen;
  seen.resize(form_.channels);
  float whole = 0.0f, most = 0.0f;
  bool hidden = false;
  for (int i = 0; i < 4; i++) {
    const bool second = i % 2 == 1, lower = i / 2 == 1;
    const float weight = (second ? part : 1.0f - part) * (lower ? down.part : 1.0f - down.part);
    const View* view = (*slits[i % 2])[static_cast<size_t>(lower ? down.second : down.first)].get();
    if (!(weight > 0.0f) || !view) continue;
    if (!view->look(pixel.ray, pixel.right, pixel.down, seen)) hidden = true;
    for (size_t c = 0; c < form_.channels; c++) {
      if (!form_.is_nearest[c]) out[c] += weight * seen[c];
      if (form_.is_nearest[c] && weight > most) out[c] = seen[c];
    }
    whole += weight, most = std::max(most, weight);
  }
  if (hidden) unseen_++;
  for (size_t c = 0; c < form_.channels && whole > 0.0f && whole < 1.0f; c++) {
    if (!form_.is_nearest[c]) out[c] /= whole;
  }
}

void Stitcher::fill_row(size_t eye, const std::map<int, Slit>& slits, const std::vector<int>& columns, int y) {
  const float height = static_cast<float>(rig_.eye.height), pitches = static_cast<float>(rig_.options.pitches);
  const float pitch_height = (pitch_border(rig_, -1) - pitch_border(rig_, 0));
  const Fade down = fade_at((static_cast<float>(y) + 0.5f) * pitches / height - 0.5f, rig_.options.pitches,
                            2.0f * pitch_fade(rig_) / pitch_height);
  float* row = reinterpret_cast<float*>(picture_->data() + pixels_from_) +
               (eye * static_cast<size_t>(rig_.eye.height) + static_cast<size_t>(y)) *
                   static_cast<size_t>(rig_.eye.width) * form_.channels;
  for (const int x : columns) {
    const float at = slit_at(x);
    const int place = static_cast<int>(std::floor(at));
    const Fade across = fade_at(at - static_cast<float>(place), 2, rig_.options.blend);
    const Slit* const two[] = {&slits.at(slit_of(place)), &slits.at(slit_of(place + 1))};
    fill_pixel(pixel_at(eye, x, y), down, two, across.part, row + static_cast<size_t>(x) * form_.channels);
  }
}

// From the middle of one slit to that of another at a time; while these are filled, the next are read.
void Stitcher::make_eye(size_t eye, const std::function<void(int slit)>& done) {
  std::vector<Batch> batches = batches_of(eye);
  for (int x = 0; x < rig_.eye.width; x++) {
    const int place =
        std::clamp(static_cast<int>(std::floor(slit_at(x))), batches.front().first, batches.back().last - 1);
    batches[static_cast<size_t>((place - batches.front().first) / slits_at_once())].columns.push_back(x);
  }
  batches.erase(std::remove_if(batches.begin(), batches.end(), [&](const Batch& batch) { return was_done(batch); }),
                batches.end());
  if (batches.empty()) return;
  std::map<int, Slit> slits = open_slits(eye, batches.front().first, batches.front().last, {});
  const std::map<int, Slit> start(slits.begin(), std::next(slits.begin()));  // the last one's neighbour, too
  for (size_t i = 0; i < batches.size(); i++) {
    std::map<int, Slit> open = slits, next;
    open.insert(start.begin(), start.end());
    tbb::task_group ahead;
    ahead.run([&] {
      if (i + 1 < batches.size()) next = open_slits(eye, batches[i + 1].first, batches[i + 1].last, open);
    });
    unseen_ = 0;
    tbb::parallel_for(0, rig_.eye.height, [&](int y) { fill_row(eye, slits, batches[i].columns, y); });
    ahead.wait();
    set_done(batches[i]);
    slits = std::move(next);
    picture_->release();
    if (done) done(batches[i].last);
  }
}

Stitched Stitcher::finish() {
  Stitched made;
  made.rows.eye = rig_.eye;
  made.rows.eyes = rig_.eyes;
  made.rows.layers = form_.layers;
  const size_t row_size = static_cast<size_t>(rig_.eye.width) * form_.channels * sizeof(float);
  made.rows.fill = [picture = picture_, from = pixels_from_, row_size, height = static_cast<size_t>(rig_.eye.height)](
                       int index, int y, std::span<float> row) {
    const size_t at = static_cast<size_t>(index) * height + static_cast<size_t>(y);
    std::memcpy(row.data(), picture->data() + from + at * row_size, row_size);
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
  stitcher.choose_form(options);
  const double all = static_cast<double>(rig.eyes.size()) * rig.options.slits;
  for (size_t eye = 0; eye < rig.eyes.size(); eye++) {
    stitcher.make_eye(eye, [&](int slit) {
      if (done) done((static_cast<double>(eye) * rig.options.slits + slit) / all);
    });
  }
  return stitcher.finish();
}

}  // namespace ods
