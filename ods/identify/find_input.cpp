// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/find_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/camera/file_names.h"
#include "ods/camera/layout.h"
#include "ods/files/frames.h"
#include "ods/identify/eye_match.h"
#include "ods/identify/thumbnail.h"
#include "ods/image/format/file_format.h"
#include "ods/picture/face_files.h"
#include "ods/video/footage.h"

namespace fs = std::filesystem;

namespace ods {

// --- words in names --------------------------------------------------------------------------------------------------

namespace {

// A word of a path, by its position.
struct Word {
  size_t at = 0;
  std::string text;
};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The words in [begin, end): letters between other characters, and a last letter after digits. With digits: px1 is one.
std::vector<Word> words_of(const std::string& path, size_t begin, size_t end, bool with_digits) {
  std::vector<Word> words;
  for (size_t i = begin; i < end; i++) {
    const bool is_of_word = is_letter(path[i]) || (with_digits && is_digit(path[i]));
    const bool continues = i > begin && (is_letter(path[i - 1]) || (with_digits && is_digit(path[i - 1])));
    if (!is_of_word) continue;
    if (!continues || words.empty()) words.push_back({i, ""});
    words.back().text += path[i];
  }
  return words;
}

// The word in the letter case of another one.
std::string in_case_of(const std::string& model, std::string_view word) {
  const auto is_capital = [&](size_t i) { return std::isupper(static_cast<unsigned char>(model[i])) != 0; };
  std::string result(word);
  for (size_t i = 0; i < result.size(); i++) {
    const bool capital = is_capital(0) && (i == 0 || (model.size() > 1 && is_capital(1)));
    if (capital) result[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[i])));
  }
  return result;
}

struct Parts {
  size_t folder, name, end;  // begin of the last folder's name, begin and end of the file's name without extension
};

Parts parts_of(const std::string& path) {
  Parts parts{0, 0, path.size()};
  const size_t slash = path.rfind('/');
  if (slash != std::string::npos) {
    parts.name = slash + 1;
    const size_t before = slash == 0 ? std::string::npos : path.rfind('/', slash - 1);
    parts.folder = before == std::string::npos ? 0 : before + 1;
  }
  const size_t dot = path.rfind('.');
  if (dot != std::string::npos && dot > parts.name) parts.end = dot;
  return parts;
}

bool exists(const std::string& path) {
  std::error_code ignored;
  if (const auto names = frame_names(path)) {
    const fs::path folder = fs::path(path).parent_path();
    return fs::is_directory(folder.empty() ? "." : folder, ignored) && !frames_on_disk(*names).empty();
  }
  return fs::exists(path, ignored);
}

// A path in which a word for an eye is exchanged, and which eye the path itself is.
struct Exchanged {
  std::string other;
  bool is_left = false;
};

// All paths in which the last word for an eye in [begin, end) is exchanged.
std::vector<Exchanged> exchanged(const std::string& path, size_t begin, size_t end) {
  std::vector<Exchanged> all;
  const std::vector<Word> words = words_of(path, begin, end, false);
  for (auto word = words.rbegin(); word != words.rend(); ++word) {
    for (const EyeWords& eyes : kEyeWordsTable) {
      const std::string small = small_letters(word->text);
      if (small != eyes.left && small != eyes.right) continue;
      Exchanged found{path, small == eyes.left};
      found.other.replace(word->at, word->text.size(), in_case_of(word->text, found.is_left ? eyes.right : eyes.left));
      all.push_back(std::move(found));
    }
  }
  return all;
}

}  // namespace

// --- eyes ------------------------------------------------------------------------------------------------------------

std::optional<EyePair> find_eye_beside(const std::string& path) {
  const Parts parts = parts_of(path);
  const auto pair = [&](const Exchanged& found) {
    return found.is_left ? EyePair{path, found.other} : EyePair{found.other, path};
  };
  for (const Exchanged& found : exchanged(path, parts.name, parts.end)) {
    if (exists(found.other)) return pair(found);
  }
  if (parts.name == 0) return std::nullopt;
  for (const Exchanged& folder : exchanged(path, parts.folder, parts.name - 1)) {
    if (exists(folder.other)) return pair(folder);
    const Parts there = parts_of(folder.other);
    for (const Exchanged& both : exchanged(folder.other, there.name, there.end)) {
      if (both.is_left == folder.is_left && exists(both.other)) return pair({both.other, folder.is_left});
    }
  }
  return std::nullopt;
}

static std::string first_of(const std::string& path) {
  const auto names = frame_names(path);
  return names ? names->path(frames_on_disk(*names).front()) : path;
}

// Returns whether the pixels of two pictures match as those of two eyes do.
static bool are_eyes(const EyePair& pair) {
  constexpr double kSure = 0.2;  // the names tell it, too
  try {
    std::vector<Image> eyes;
    Extent size;
    for (const std::string& path : {first_of(pair.left), first_of(pair.right)}) {
      OpenOptions options;
      options.color_only = true;
      PictureReader reader = PictureReader::without_format(path, options);
      const Extent each{reader.info().width, reader.info().height};
      if (!eyes.empty() && (each.width != size.width || each.height != size.height)) return false;
      size = each;
      eyes.push_back(make_thumbnail(reader.whole()).light);
    }
    return match_eyes(eyes).mark() > kSure;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return false;
  }
}

static std::string name_of_pair(const EyePair& pair) {
  if (const std::optional<std::string> name = joined_name({pair.left, pair.right})) return *name;
  throw Error(ErrorKind::kUsage, fmt::format("'{}' and '{}' cannot be read together, because {{ and | have a meaning "
                                             "in the names of pairs: rename them",
                                             pair.left, pair.right));
}

// FFmpeg's command that puts the eyes of two videos side by side.
static std::string joining_command(const EyePair& pair) {
  return shell_line(
      {"ffmpeg", "-i", pair.left, "-i", pair.right, "-filter_complex", "hstack", "-c:a", "copy", "both_LR.mp4"});
}

[[noreturn]] static void refuse_videos(const EyePair& pair) {
  throw Error(ErrorKind::kInput, fmt::format("'{}' and '{}' are two videos: join them into one first, {}", pair.left,
                                             pair.right, joining_command(pair)));
}

static bool is_film(const std::string& path) {
  return !names_files(path) && footage_kind(path) == FootageKind::kVideo;
}

// --- faces -----------------------------------------------------------------------------------------------------------

namespace {

// The files of six faces by the order of kFaceWordsTable.
struct FaceFiles {
  const FaceWords* words = nullptr;
  std::vector<std::string> files;
};

std::string listed(const FaceWords& row) {
  return fmt::format("{}", fmt::join(row.words, " "));
}

// The face that a word is, in a row of the table.
std::optional<size_t> face_of(const FaceWords& row, const std::string& word) {
  const auto found = std::ranges::find(row.words, small_letters(word));
  return found == row.words.end() ? std::nullopt : std::optional(static_cast<size_t>(found - row.words.begin()));
}

// The six files that differ from this one only in the word for the face, if all exist.
std::optional<FaceFiles> find_faces_beside(const std::string& path) {
  const Parts parts = parts_of(path);
  const std::vector<Word> words = words_of(path, parts.name, parts.end, true);
  for (auto word = words.rbegin(); word != words.rend(); ++word) {
    for (const FaceWords& row : kFaceWordsTable) {
      if (!face_of(row, word->text)) continue;
      FaceFiles faces{&row, {}};
      for (const std::string_view each : row.words) {
        std::string file = path;
        file.replace(word->at, word->text.size(), in_case_of(word->text, each));
        if (exists(file)) faces.files.push_back(std::move(file));
      }
      if (faces.files.size() == kFaceCount) return faces;
    }
  }
  return std::nullopt;
}

// The faces of each eye in these files: one set or two. Returns none if they are something else.
std::vector<FaceFiles> sets_of_faces(const std::vector<std::string>& paths) {
  std::vector<FaceFiles> sets;
  size_t count = 0;
  for (const std::string& path : paths) {
    const auto is_there = [&](const FaceFiles& faces) {
      return std::ranges::find(faces.files, path) != faces.files.end();
    };
    if (std::ranges::any_of(sets, is_there)) continue;
    std::optional<FaceFiles> faces = find_faces_beside(path);
    if (!faces) return {};
    count += kFaceCount;
    sets.push_back(std::move(*faces));
  }
  if (count != paths.size()) return {};
  return sets;
}

std::string name_of_faces(const FaceFiles& faces) {
  if (!faces.words->doubt.empty()) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' is one of six faces named {}, and {}: rename them to {}", faces.files.front(),
                            listed(*faces.words), faces.words->doubt, listed(kFaceWordsTable[0])));
  }
  if (const std::optional<std::string> name = joined_name(faces.files)) return *name;
  throw Error(ErrorKind::kUsage,
              fmt::format("'{}' cannot be read with the other faces, because {{ and | have a meaning in the names of "
                          "six files: rename them",
                          faces.files.front()));
}

std::string name_of_sets(const std::vector<FaceFiles>& sets) {
  if (sets.size() == 1) return name_of_faces(sets[0]);
  const auto beside = find_eye_beside(sets[0].files[0]);
  const bool fits = beside && (std::ranges::find(sets[1].files, beside->left) != sets[1].files.end() ||
                               std::ranges::find(sets[1].files, beside->right) != sets[1].files.end());
  if (!fits) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' and '{}' are faces of two cubes, but their names do not tell the "
                                               "eye: name them left_px.png and right_px.png",
                                               sets[0].files[0], sets[1].files[0]));
  }
  const bool is_left = beside->left == sets[0].files[0];
  return name_of_pair({name_of_faces(sets[is_left ? 0 : 1]), name_of_faces(sets[is_left ? 1 : 0])});
}

}  // namespace

// --- folders ---------------------------------------------------------------------------------------------------------

static std::vector<std::string> pictures_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const std::string path = entry->path().string();
    if (entry->is_regular_file(ignored) && names_picture(path)) paths.push_back(path);
  }
  std::ranges::sort(paths);
  return paths;
}

// The folders of both eyes in a folder.
static std::optional<EyePair> folders_in(const std::string& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_directory(ignored)) continue;
    const std::string path = entry->path().string();
    for (const Exchanged& found : exchanged(path, parts_of(path).name, path.size())) {
      if (fs::is_directory(found.other, ignored)) {
        return found.is_left ? EyePair{path, found.other} : EyePair{found.other, path};
      }
    }
  }
  return std::nullopt;
}

// The one file or the numbered frames in a folder: frames differ only in their last number.
static std::string content_of(const std::string& folder) {
  const std::vector<std::string> paths = pictures_in(folder);
  if (paths.size() == 1) return paths[0];
  if (paths.size() == kFaceCount) {
    const std::vector<FaceFiles> sets = sets_of_faces(paths);
    if (sets.size() == 1 && sets[0].words->doubt.empty()) return name_of_faces(sets[0]);
  }
  std::map<std::string, size_t> patterns;
  for (const std::string& path : paths) {
    const Parts parts = parts_of(path);
    size_t end = parts.end;
    while (end > parts.name && !is_digit(path[end - 1])) end--;
    size_t begin = end;
    while (begin > parts.name && is_digit(path[begin - 1])) begin--;
    if (begin < end) patterns[path.substr(0, begin) + std::string(end - begin, '#') + path.substr(end)]++;
  }
  if (patterns.size() == 1 && patterns.begin()->second == paths.size() && !paths.empty())
    return patterns.begin()->first;
  throw Error(
      ErrorKind::kInput,
      fmt::format("'{}' has {} pictures that are not the frames of one shot: name one of them", folder, paths.size()));
}

static std::string pair_of_folders(const EyePair& folders) {
  return name_of_pair({content_of(folders.left), content_of(folders.right)});
}

static FoundInput in_folder(const std::string& folder) {
  const std::vector<std::string> paths = pictures_in(folder);
  const std::vector<FaceFiles> sets = sets_of_faces(paths);
  if (sets.size() == 1 || sets.size() == 2) return {name_of_sets(sets), {}};
  if (const auto folders = folders_in(folder)) return {pair_of_folders(*folders), {}};
  return {folder, {}};
}

// --- all together ----------------------------------------------------------------------------------------------------

static FoundInput beside_one(const std::string& path) {
  if (names_files(path) || !exists(path)) return {path, {}};
  const auto faces = find_faces_beside(path);
  if (faces && !is_digit(faces->words->words[0][0])) {
    const std::string name = name_of_faces(*faces);
    return {name,
            {fmt::format("'{}' is one of six faces, and all are read; to read it alone, specify `projection`", path)}};
  }
  const std::optional<EyePair> pair = find_eye_beside(path);
  if (!pair || is_film(path)) {
    if (!pair || !is_film(pair->right)) return {path, {}};
    return {path,
            {fmt::format("'{}' is taken alone; if '{}' is its other eye, join them: {}", path,
                         path == pair->left ? pair->right : pair->left, joining_command(*pair))}};
  }
  const std::string& other = path == pair->left ? pair->right : pair->left;
  if (are_eyes(*pair)) {
    return {name_of_pair(*pair),
            {fmt::format("'{}' is one eye, and '{}' the other: both are read; to read it alone, use `layout` separate",
                         path, other)}};
  }
  return {path, {fmt::format("'{}' is taken alone; if '{}' is its other eye, name both", path, other)}};
}

static FoundInput of_two(const std::string& first, const std::string& second) {
  std::error_code ignored;
  const auto is_folder = [&](const std::string& path) { return fs::is_directory(path, ignored); };
  EyePair pair{first, second};
  const std::optional<EyePair> told = find_eye_beside(first);
  std::vector<std::string> notes;
  if (told && (told->left == second || fs::equivalent(told->left, second, ignored))) {
    pair = {second, first};
    notes.push_back(fmt::format("'{}' is the left eye, by its name", second));
  }
  if (is_folder(first) != is_folder(second)) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}' and '{}' are a file and a folder: two inputs are the left eye and "
                                               "the right one",
                                               first, second));
  }
  if (is_folder(first)) return {pair_of_folders(pair), notes};
  if (is_film(first) || is_film(second)) refuse_videos(pair);
  return {name_of_pair(pair), notes};
}

FoundInput find_input(const std::vector<std::string>& paths, bool alone) {
  std::error_code ignored;
  if (paths.size() == 1) {
    if (fs::is_directory(paths[0], ignored)) return in_folder(paths[0]);
    return alone ? FoundInput{paths[0], {}} : beside_one(paths[0]);
  }
  if (paths.size() == 2) return of_two(paths[0], paths[1]);
  const std::vector<FaceFiles> sets = sets_of_faces(paths);
  if (sets.size() == 1 || sets.size() == 2) return {name_of_sets(sets), {}};
  throw Error(ErrorKind::kUsage,
              fmt::format("{} inputs are not one picture: name one, two (left eye, right eye), or the six faces of a "
                          "cube by the words {}",
                          paths.size(), listed(kFaceWordsTable[0])));
}

}  // namespace ods
