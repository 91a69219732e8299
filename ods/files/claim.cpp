// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/claim.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/files/md5.h"

namespace ods {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFirstLine = "omnistereo claim";

// Closes, and thereby unlocks, a descriptor unless it is released first.
class File {
 public:
  explicit File(int number) : number_(number) {}
  File(File&& other) noexcept : number_(other.hand_on()) {}
  File& operator=(const File&) = delete;
  ~File() {
    if (number_ >= 0) close(number_);
  }
  int number() const { return number_; }
  int hand_on() { return std::exchange(number_, -1); }

 private:
  int number_;
};

// The holder that a claim file names.
struct Holder {
  std::string host, boot, process, since;
  bool empty() const { return process.empty(); }
};

enum class Lock { kOurs, kTheirs, kUnknown };  // unknown: the disk has no locks

Error cannot_claim(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kOutput, fmt::format("cannot claim '{}': {}", path, why));
}

std::string host_name() {
  char name[64] = "";
  gethostname(name, sizeof(name) - 1);
  return name;
}

// Identifies the running kernel: the same for all its processes, different after each boot.
std::string boot_name() {
  std::string name;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> name;
  return name.empty() ? host_name() : name;
}

bool is_at(int file, const std::string& path) {
  struct stat own, there;
  return fstat(file, &own) == 0 && lstat(path.c_str(), &there) == 0 && own.st_dev == there.st_dev &&
         own.st_ino == there.st_ino;
}

Lock lock(int file, int how) {
  int result = 0;
  do {
    result = flock(file, how);
  } while (result != 0 && errno == EINTR);
  return result == 0 ? Lock::kOurs : errno == EWOULDBLOCK ? Lock::kTheirs : Lock::kUnknown;
}

void write_holder(int file, const std::string& path) {
  const std::string text = fmt::format("{}\nhost {}\nboot {}\nprocess {}\nsince {:%Y-%m-%d %H:%M:%S} UTC\n", kFirstLine,
                                       host_name(), boot_name(), getpid(), fmt::gmtime(std::time(nullptr)));
  if (pwrite(file, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size())) return;
  const int code = errno;
  unlink(path.c_str());
  throw cannot_claim(path, code == 0 ? "the disk is full" : std::strerror(code));
}

// Empty if the claimant has not written it yet.
Holder read_holder(int file, const std::string& path) {
  std::array<char, 1024> bytes{};
  const ssize_t size = pread(file, bytes.data(), bytes.size(), 0);
  std::istringstream text(std::string(bytes.data(), static_cast<size_t>(std::max<ssize_t>(size, 0))));
  Holder holder;
  std::string line;
  if (!std::getline(text, line)) return holder;
  if (line != kFirstLine) throw cannot_claim(path, "another kind of file has that name; remove it");
  while (std::getline(text, line)) {
    const size_t space = std::min(line.find(' '), line.size());
    const std::string key = line.substr(0, space), value = line.substr(std::min(space + 1, line.size()));
    if (key == "host") holder.host = value;
    if (key == "boot") holder.boot = value;
    if (key == "process") holder.process = value;
    if (key == "since") holder.since = value;
  }
  return holder;
}

std::chrono::nanoseconds in_ns(const timespec& time) {
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// The time since the last update of the claim, by the clock of its disk, because machines' clocks differ.
std::chrono::nanoseconds silence_of(int file, const std::string& path) {
  struct stat claim, now;
  if (fstat(file, &claim) != 0) return {};
  std::string name = (fs::path(path).parent_path() / ".ods-clock-XXXXXX").native();
  const File clock(mkostemp(name.data(), O_CLOEXEC));
  if (clock.number() < 0) return {};
  unlink(name.c_str());
  if (futimens(clock.number(), nullptr) != 0 || fstat(clock.number(), &now) != 0) return {};
  return in_ns(now.st_mtim) - in_ns(claim.st_mtim);
}

std::string words_for(const Holder& holder, const ClaimTimes& times) {
  if (holder.empty()) return "another process";
  std::string words = fmt::format("process {} on '{}', since {}", holder.process, holder.host, holder.since);
  if (holder.boot != boot_name()) {
    words += fmt::format(" (if that machine died, wait {} s)",
                         std::chrono::duration_cast<std::chrono::seconds>(times.silence).count());
  }
  return words;
}

// Creates, locks and writes a claim file; a closed File if one exists already.
File make_claim(const std::string& path) {
  File file(open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (file.number() < 0 && errno != EEXIST) throw cannot_claim(path, std::strerror(errno));
  if (file.number() < 0) return file;
  lock(file.number(), LOCK_EX);  // another process may be reading it
  write_holder(file.number(), path);
  return file;
}

File open_claim(const std::string& path) {
  for (const int mode : {O_RDWR, O_RDONLY}) {  // another user's claim can only be read
    const int file = open(path.c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file >= 0 || errno == ENOENT) return File(file);
    if (errno != EACCES && errno != EROFS) break;
  }
  throw cannot_claim(path, errno == ELOOP ? "it is a link; remove it" : std::strerror(errno));
}

enum class Verdict { kGone, kEmpty, kHeld, kDied, kSilent };

// Decides whether another process's claim is valid. Removes it if its holder is dead. An empty one is removed, too: its
// maker died before writing, or will write once we release the lock, and then find that it lost the claim.
Verdict judge(const std::string& path, const ClaimTimes& times, bool was_empty, std::string& words) {
  const File file = open_claim(path);
  if (file.number() < 0) return Verdict::kGone;
  const Lock locked = lock(file.number(), LOCK_EX | LOCK_NB);
  const Holder holder = read_holder(file.number(), path);
  words = words_for(holder, times);
  if (locked == Lock::kTheirs) return Verdict::kHeld;
  if (holder.empty() && !was_empty) return Verdict::kEmpty;
  const bool died = locked == Lock::kOurs && holder.boot == boot_name();
  if (!died && !holder.empty() && silence_of(file.number(), path) < times.silence) return Verdict::kHeld;
  if (is_at(file.number(), path) && unlink(path.c_str()) != 0 && errno != ENOENT) {
    throw cannot_claim(path,
                       fmt::format("{} died and left it, and it cannot be removed: {}", words, std::strerror(errno)));
  }
  return died ? Verdict::kDied : Verdict::kSilent;
}

}  // namespace

std::string claim_path(const std::string& path) {
  const size_t kLongest = 240;  // of 255 bytes
  const fs::path file(path);
  const std::string name = file.filename().native();
  return (file.parent_path() / fmt::format(".{}.claim", name.size() > kLongest ? md5(name) : name)).native();
}

std::unique_ptr<Claim> try_claim(const std::string& path, std::string& holder, ClaimTimes times) {
  const std::string claim = claim_path(path);
  const fs::path folder = fs::path(claim).parent_path();
  std::error_code ignored;  // making the file reports it
  if (!folder.empty()) fs::create_directories(folder, ignored);
  const int kLooks = 4;  // another process may be taking over a dead claim right now
  bool was_silent = false, was_empty = false;
  for (int looks = 0; looks < kLooks;) {
    File file = make_claim(claim);
    if (file.number() >= 0) {
      if (was_silent) std::this_thread::sleep_for(times.settle);
      if (is_at(file.number(), claim)) return std::make_unique<Claim>(file.hand_on(), claim, times);
    }
    const Verdict verdict = judge(claim, times, was_empty, holder);
    was_silent = was_silent || verdict == Verdict::kSilent;
    was_empty = verdict == Verdict::kEmpty;
    if (was_empty) std::this_thread::sleep_for(times.settle);  // its maker may be on another machine
    if (verdict != Verdict::kHeld) continue;
    looks++;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return nullptr;
}

std::unique_ptr<Claim> claim(const std::string& path, std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  std::string holder;
  std::unique_ptr<Claim> own = try_claim(path, holder);
  while (!own && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    own = try_claim(path, holder);
  }
  if (!own) throw Error(ErrorKind::kOutput, fmt::format("another ods is at work on '{}': {}", path, holder));
  return own;
}

Claim::Claim(int file, std::string path, ClaimTimes times) : file_(file), path_(std::move(path)) {
  remember_unfinished(path_.c_str());
  beat_ = std::thread([this, times] { renew_until_released(times); });
}

Claim::~Claim() {
  {
    const std::lock_guard guard(mutex_);
    released_ = true;
  }
  changed_.notify_one();
  beat_.join();
  if (is_at(file_, path_)) unlink(path_.c_str());
  forget_unfinished(path_.c_str());
  close(file_);
}

void Claim::renew_until_released(ClaimTimes times) {
  std::unique_lock guard(mutex_);
  while (!changed_.wait_for(guard, times.beat, [&] { return released_; })) {
    if (!is_at(file_, path_)) lost_ = true;
    futimens(file_, nullptr);
  }
}

void Claim::check() const {
  if (!lost_) return;
  throw Error(ErrorKind::kOutput,
              fmt::format("'{}' was taken over by another ods while this one was suspended", path_));
}

}  // namespace ods
