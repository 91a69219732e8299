// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <filesystem>
#include <numeric>
#include <string_view>
#include <unordered_set>

#include "ods/base/error.h"

namespace ods {

namespace {

constexpr size_t kMaxDigits = 9;
constexpr size_t kMaxFrames = 1'000'000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

size_t digits_at(std::string_view text, size_t start) {
  size_t count = 0;
  while (start + count < text.size() && is_digit(text[start + count])) ++count;
  return count;
}

// Consumes tokens from the front of a text.
struct Reader {
  const std::string& whole;  // for messages
  std::string_view rest;

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ErrorKind::kUsage,
                fmt::format("frames '{}': {}; write them like 1-100, 1-100x2 or 1,5,10-20", whole, why));
  }

  bool take(std::string_view word) {
    if (!rest.starts_with(word)) return false;
    rest.remove_prefix(word.size());
    return true;
  }

  int number() {
    const size_t sign = rest.starts_with('-') ? 1 : 0;
    const size_t digits = digits_at(rest, sign);
    if (digits == 0) fail(rest.empty() ? "a number is missing at the end" : fmt::format("'{}' is not a number", rest));
    if (digits > kMaxDigits) fail(fmt::format("a number has at most {} digits", kMaxDigits));
    int value = 0;
    std::from_chars(rest.data(), rest.data() + sign + digits, value);
    rest.remove_prefix(sign + digits);
    return value;
  }
};

struct Range {
  int first, last, step;
};

Range read_range(Reader& reader) {
  Range range{reader.number(), 0, 0};
  range.last = range.first;
  range.step = 1;
  if (!reader.take("..") && !reader.take("-")) return range;
  range.last = reader.number();
  const int direction = range.last < range.first ? -1 : 1;
  range.step = direction;
  if (!reader.take("x") && !reader.take(":")) return range;
  const int step = reader.number();
  if (step == 0) reader.fail("the step is 0");
  if (step < 0 && direction > 0) {
    reader.fail(fmt::format("a step of {} does not lead from {} to {}", step, range.first, range.last));
  }
  range.step = direction * std::abs(step);
  return range;
}

// The length of the frame mark that starts here, 0 if there is none, and its number of digits.
size_t mark_at(std::string_view name, size_t start, int& digits) {
  const std::string_view rest = name.substr(start);
  for (char mark : {'#', '@'}) {
    const size_t count = std::min(rest.find_first_not_of(mark), rest.size());
    if (count == 0) continue;
    digits = static_cast<int>(count);
    return count;
  }
  if (rest.starts_with("{frame}")) {
    digits = 1;
    return 7;
  }
  const size_t head = rest.starts_with("%") ? 1 : rest.starts_with("$F") ? 2 : 0;
  if (head == 0) return 0;
  const size_t count = digits_at(rest, head);
  const bool ends = head == 2 || rest.substr(head + count).starts_with('d');
  if (!ends || count > 2) return 0;
  digits = 1;
  std::from_chars(rest.data() + head, rest.data() + head + count, digits);
  digits = std::max(digits, 1);
  return head + count + (head == 1 ? 1 : 0);
}

}  // namespace

std::vector<int> parse_frames(const std::string& text) {
  std::string packed = text;
  std::erase_if(packed, [](char c) { return c == ' ' || c == '\t'; });
  Reader reader{text, packed};
  const bool in_brackets = reader.take("[");
  std::vector<int> frames;
  std::unordered_set<int> seen;
  do {
    const Range range = read_range(reader);
    const auto count = static_cast<size_t>((int64_t{range.last} - range.first) / range.step) + 1;
    if (count > kMaxFrames || frames.size() + count > kMaxFrames) {
      reader.fail(fmt::format("it has more than {} frames", kMaxFrames));
    }
    for (size_t i = 0; i < count; ++i) {
      const int frame = range.first + static_cast<int>(i) * range.step;
      if (seen.insert(frame).second) frames.push_back(frame);
    }
  } while (reader.take(","));
  if (in_brackets && !reader.take("]")) reader.fail("the bracket is not closed");
  if (!reader.rest.empty()) reader.fail(fmt::format("'{}' is not understood", reader.rest));
  return frames;
}

std::string frames_text(const std::vector<int>& frames) {
  std::string text;
  for (size_t i = 0; i < frames.size();) {
    const int64_t step = i + 1 < frames.size() ? int64_t{frames[i + 1]} - frames[i] : 1;
    size_t end = i + 1;
    while (end < frames.size() && int64_t{frames[end]} - frames[end - 1] == step) ++end;
    const bool is_range = end - i > 2 || (end - i == 2 && std::abs(step) == 1);
    if (!is_range) end = i + 1;
    text += fmt::format("{}{}", text.empty() ? "" : ",", frames[i]);
    if (is_range) text += fmt::format("-{}", frames[end - 1]);
    if (is_range && std::abs(step) != 1) text += fmt::format("x{}", std::abs(step));
    i = end;
  }
  return text;
}

std::vector<int> gaps(const std::vector<int>& frames) {
  int64_t step = 0;
  for (size_t i = 1; i < frames.size(); ++i) {
    assert(frames[i - 1] < frames[i]);
    step = std::gcd(step, int64_t{frames[i]} - frames[i - 1]);
  }
  std::vector<int> missing;
  for (size_t i = 1; i < frames.size(); ++i) {
    for (int64_t frame = frames[i - 1] + step; frame < frames[i] && missing.size() < kMaxFrames; frame += step) {
      missing.push_back(static_cast<int>(frame));
    }
  }
  return missing;
}

std::string FrameNames::path(int frame) const {
  // The sign counts as a digit, as in printf.
  return fmt::format("{}{:0{}}{}", before, frame, digits, after);
}

std::optional<FrameNames> frame_names(const std::string& path) {
  std::optional<FrameNames> names;
  const size_t slash = path.rfind('/');
  for (size_t i = slash == std::string::npos ? 0 : slash + 1; i < path.size();) {
    int digits = 0;
    const size_t length = mark_at(path, i, digits);
    if (length > 0) names = FrameNames{path.substr(0, i), path.substr(i + length), digits};
    i += std::max<size_t>(length, 1);
  }
  return names;
}

std::vector<int> frames_on_disk(const FrameNames& names) {
  namespace fs = std::filesystem;
  const size_t slash = names.before.rfind('/');
  const size_t name_start = slash == std::string::npos ? 0 : slash + 1;
  const std::string folder = names.before.substr(0, name_start);
  std::error_code error;
  fs::directory_iterator entries(folder.empty() ? "." : folder, error);
  if (error) {
    throw Error(ErrorKind::kInput,
                fmt::format("{}: cannot be read: {}", folder.empty() ? "." : folder, error.message()));
  }
  std::vector<int> frames;
  for (; entries != fs::directory_iterator(); entries.increment(error)) {
    const std::string path = folder + entries->path().filename().native();
    if (path.size() <= names.before.size() + names.after.size() || !path.starts_with(names.before)) continue;
    int frame = 0;
    const auto [end, fault] = std::from_chars(path.data() + names.before.size(), path.data() + path.size(), frame);
    if (fault == std::errc() && names.path(frame) == path) frames.push_back(frame);
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

}  // namespace ods
