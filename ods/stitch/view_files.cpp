// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/view_files.h"

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include "ods/base/error.h"
#include "ods/convert/reproject.h"
#include "ods/files/atomic_file.h"
#include "ods/files/frames.h"
#include "ods/files/md5.h"
#include "ods/files/read_file.h"
#include "ods/files/scratch.h"
#include "ods/stitch/rig_mark.h"
#include "ods/stitch/slit_file.h"

namespace ods {

namespace {

// The eye and the number that select a view's file.
struct Named {
  int eye = kMono;
  int number = 0;
};

size_t views_of_sheet(const ViewFiles& files) {
  return static_cast<size_t>(files.columns) * static_cast<size_t>(files.rows);
}

// A view's index among those numbered together: all, or its eye's.
size_t place_of(const SlitRig& rig, const ViewFiles& files, size_t view) {
  return names_eye(files.names) ? view % (rig.views.size() / rig.eyes.size()) : view;
}

Named named(const SlitRig& rig, const ViewFiles& files, size_t view) {
  const size_t of_eye = rig.views.size() / rig.eyes.size();
  return {rig.eyes[view / of_eye], static_cast<int>(place_of(rig, files, view) / views_of_sheet(files)) + 1};
}

// Blender's multilayer files name the depth ViewLayer.Depth.Z; in other files it is Z.
void call_depth_z(StoredPicture& picture) {
  if (depth_layer(picture)) return;
  for (LayerPixels& layer : picture.eyes[0].layers) {
    if (layer.channels.size() != 1 || !layer.channels[0].ends_with(".Depth.Z")) continue;
    layer.channels[0] = "Z";
    return;
  }
}

// Matches N.X, N.Y, N.Z; names in multilayer files have the same ending.
bool is_normal(const LayerPixels& layer) {
  if (layer.channels.size() != 3 || (layer.sample != SampleType::kHalf && layer.sample != SampleType::kFloat))
    return false;
  const std::string name = layer.channels[0].substr(0, layer.channels[0].rfind('.'));
  if (layer.channels != std::vector<std::string>{name + ".X", name + ".Y", name + ".Z"}) return false;
  return name == "N" || name == "Normal" || name.ends_with(".N") || name.ends_with(".Normal");
}

// In place, because nothing else reads the view's pixels.
void turn_normals(const StoredPicture& picture, const Camera& camera) {
  for (const LayerPixels& layer : picture.eyes[0].layers) {
    if (!is_normal(layer)) continue;
    const size_t size = bytes_of(layer.sample);
    std::byte* first = picture.memory->data() + (layer.first - picture.memory->data());
    for (int y = 0; y < picture.size.height; y++) {
      for (int x = 0; x < picture.size.width; x++) {
        std::byte* at = first + y * layer.row_stride + x * layer.pixel_stride;
        vec3 own;
        for (int c = 0; c < 3; c++) own[c] = sample_value(layer.sample, at + static_cast<size_t>(c) * size);
        const vec3 turned = camera.right * own.x + camera.up * own.y + camera.back * own.z;
        if (layer.sample == SampleType::kFloat) {
          std::memcpy(at, &turned.x, sizeof turned);
        } else {
          uint16_t halves[3];
          floats_to_halves({&turned.x, 3}, halves);
          std::memcpy(at, halves, sizeof halves);
        }
      }
    }
  }
}

// mark: of the rig that the file should belong to.
StoredPicture open_file(const std::string& path, const StereoCamera& pose, const std::string& mark) {
  OpenOptions options;
  options.format.one_eye = true;
  options.format.camera = pose;
  StoredPicture picture = open_picture(path, options);
  if (!picture.rig_mark.empty()) check_rig_mark(picture.rig_mark, mark, path);
  call_depth_z(picture);
  return picture;
}

void check_size(Extent is, Extent should, const std::string& path) {
  if (is.width == should.width && is.height == should.height) return;
  throw Error(ErrorKind::kInput,
              fmt::format("'{}' is {}x{}, not {}x{}", path, is.width, is.height, should.width, should.height));
}

// The view with this index in a sheet.
StoredPicture part_of(StoredPicture sheet, const ViewFiles& files, Extent view, size_t index) {
  const size_t across = static_cast<size_t>(files.columns), down = static_cast<size_t>(files.rows);
  const size_t column = files.by_columns ? index / down : index % across;
  const size_t row = files.by_columns ? index % down : index / across;
  sheet.size = view;
  for (LayerPixels& layer : sheet.eyes[0].layers) {
    layer.first += static_cast<ptrdiff_t>(column) * view.width * layer.pixel_stride +
                   static_cast<ptrdiff_t>(row) * view.height * layer.row_stride;
  }
  return sheet;
}

// Sheets with views that are still to be read.
class Sheets {
 public:
  Sheets(const SlitRig& rig, ViewFiles files) : rig_(rig), mark_(rig_mark(rig)), files_(std::move(files)) {}

  StoredPicture view(size_t index) {
    const std::string path = view_path(rig_, files_, index);
    const size_t in_sheet = place_of(rig_, files_, index) % views_of_sheet(files_);
    std::shared_ptr<Sheet> sheet;
    {
      const std::lock_guard lock(mutex_);
      sheet = sheets_[path] ? sheets_[path] : (sheets_[path] = std::make_shared<Sheet>());
    }
    StoredPicture part;
    {
      const std::lock_guard lock(sheet->mutex);
      if (!sheet->picture) sheet->picture = open_whole(path, index);
      part = part_of(*sheet->picture, files_, rig_.view, in_sheet);
      sheet->given++;
    }
    const std::lock_guard lock(mutex_);
    if (sheet->given == views_of_sheet(files_)) sheets_.erase(path);
    return part;
  }

 private:
  struct Sheet {
    std::mutex mutex;
    std::optional<StoredPicture> picture;
    std::atomic<size_t> given{0};
  };

  StoredPicture open_whole(const std::string& path, size_t index) {
    StoredPicture whole = open_file(path, rig_.views[index], mark_);
    check_size(whole.size, {rig_.view.width * files_.columns, rig_.view.height * files_.rows}, path);
    return whole;
  }

  const SlitRig& rig_;
  const std::string mark_;
  ViewFiles files_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Sheet>> sheets_;
};

}  // namespace

std::string names_fault(const SlitRig& rig, const ViewFiles& files) {
  if (!frame_names(files.names)) {
    return fmt::format("'{}' has no placeholder for the view's number, as in views/####.exr", files.names);
  }
  if (names_eye(files.names) && rig.eyes.size() < 2) {
    return fmt::format("'{}' is for two eyes, but the rig has one", files.names);
  }
  if (views_of_sheet(files) > rig.views.size()) {
    return fmt::format("a sheet of {}x{} has more views than the rig ({})", files.columns, files.rows,
                       rig.views.size());
  }
  return "";
}

std::string view_path(const SlitRig& rig, const ViewFiles& files, size_t view) {
  const Named name = named(rig, files, view);
  return path_for_eye(frame_names(files.names)->path(name.number), name.eye);
}

// --- marks of folders ------------------------------------------------------------------------------------------------

std::vector<std::string> view_folders(const SlitRig& rig, const ViewFiles& files) {
  std::set<std::string> folders;
  for (size_t i = 0; i < rig.views.size(); i++) {
    const std::string path = view_path(rig, files, i);
    folders.insert(path.substr(0, path.rfind('/') + 1));
  }
  return {folders.begin(), folders.end()};
}

bool has_rig_marks(const SlitRig& rig, const ViewFiles& files) {
  constexpr size_t kLargestMark = 1 << 16;
  const std::string expected = rig_mark(rig);
  bool all = true;
  for (const std::string& folder : view_folders(rig, files)) {
    const std::string path = folder + kRigMarkFile;
    std::error_code error;
    if (!std::filesystem::exists(path, error) && !error) {
      all = false;
      continue;
    }
    const std::vector<unsigned char> bytes = read_file(path, kLargestMark);
    check_rig_mark(mark_in_file({bytes.begin(), bytes.end()}), expected, path);
  }
  return all;
}

void mark_folders(const SlitRig& rig, const ViewFiles& files) {
  if (has_rig_marks(rig, files)) return;
  const std::string text = mark_file_text(rig_mark(rig));
  for (const std::string& folder : view_folders(rig, files)) {
    std::error_code ignored;  // writing reports the error
    if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
    write_file(folder + kRigMarkFile, text);
  }
}

// --- views -----------------------------------------------------------------------------------------------------------

OpenView open_view_files(const SlitRig& rig, const ViewFiles& files) {
  return [&rig, sheets = std::make_shared<Sheets>(rig, files), turn = files.own_normals](size_t view) {
    StoredPicture picture = sheets->view(view);
    if (turn) turn_normals(picture, make_camera(rig.views[view]));
    return picture;
  };
}

// The fault of a file, for messages. Empty if it has none.
static std::string fault_of(const std::string& path, const StereoCamera& pose, Extent size, const std::string& mark,
                            bool thorough) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  if (error == std::errc::no_such_file_or_directory) return fmt::format("'{}' does not exist", path);
  if (error) return fmt::format("'{}' cannot be read: {}", path, error.message());
  if (bytes == 0) return fmt::format("'{}' is empty", path);
  if (!thorough) return "";
  try {
    check_size(open_file(path, pose, mark).size, size, path);
  } catch (const Error& fault) {
    if (fault.kind() != ErrorKind::kInput) throw;
    return fault.what();
  }
  return "";
}

std::vector<ViewFault> missing_views(const SlitRig& rig, const ViewFiles& files, bool thorough) {
  std::map<std::string, std::vector<size_t>> views_of;  // per file
  for (size_t i = 0; i < rig.views.size(); i++) views_of[view_path(rig, files, i)].push_back(i);
  const Extent size{rig.view.width * files.columns, rig.view.height * files.rows};
  const std::string mark = rig_mark(rig);
  std::vector<std::string> found(rig.views.size());
  tbb::parallel_for_each(views_of, [&](const auto& file) {
    const auto& [path, views] = file;
    const std::string fault = fault_of(path, rig.views[views.front()], size, mark, thorough);
    for (const size_t view : views) found[view] = fault;
  });
  std::vector<ViewFault> faults;
  for (size_t i = 0; i < found.size(); i++) {
    if (!found[i].empty()) faults.push_back({i, found[i]});
  }
  return faults;
}

uint64_t views_key(const SlitRig& rig, const ViewFiles& files) {
  std::string all = write_slit_rig(rig) + (files.own_normals ? "own normals" : "");
  for (size_t i = 0; i < rig.views.size(); i++) all += file_identity(view_path(rig, files, i)) + "\n";
  return std::stoull(md5(all).substr(0, 16), nullptr, 16);
}

std::string view_ranges(const SlitRig& rig, const ViewFiles& files, const std::vector<ViewFault>& faults) {
  std::string text;
  for (const int eye : rig.eyes) {
    std::vector<int> numbers;
    for (const ViewFault& fault : faults) {
      const Named name = named(rig, files, fault.view);
      const bool counts = name.eye == eye || !names_eye(files.names);
      if (counts && (numbers.empty() || numbers.back() != name.number)) numbers.push_back(name.number);
    }
    if (!names_eye(files.names)) return frames_text(numbers);
    if (!numbers.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : " ", eye_name(eye), frames_text(numbers));
  }
  return text;
}

}  // namespace ods
