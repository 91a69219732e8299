// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shared by the few files that use FFmpeg: owning handles, and one-line errors.
#pragma once
#include <cstdint>
#include <memory>
#include <new>
#include <string>

#include "ods/base/error.h"

struct AVAudioFifo;
struct AVCodecContext;
struct AVFormatContext;
struct AVFrame;
struct AVPacket;
struct AVStream;
struct SwrContext;

namespace ods::av {

struct Free {
  void operator()(AVCodecContext* context) const;
  void operator()(AVFrame* frame) const;
  void operator()(AVPacket* packet) const;
  void operator()(SwrContext* context) const;
  void operator()(AVAudioFifo* fifo) const;
  void operator()(AVFormatContext* context) const;
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

template <typename T>
T* made(T* object) {
  if (object == nullptr) throw std::bad_alloc();
  return object;
}

// Captures the libraries' log for the next error message instead of printing it, beginning with what is logged from now
// on.
void keep_complaints();

// Returns the code if it is not negative. Otherwise throws Error with `what`, our own text for the reason and the
// library's log message; out of memory is always kMemory, regardless of `kind`.
int checked(int code, ErrorKind kind, const std::string& what);

// Like checked(), for reads that need little memory, such as a header or sound: if they run out of memory, the file
// makes impossible claims. Throws Error(kInput).
int checked_small_input(int code, const std::string& what);

// Opens a local file, never a URL, and probes its streams. Throws Error(kInput) with a message that starts with `what`.
Owned<AVFormatContext> open_file(const std::string& path, const std::string& what);

// The stream of a track (video_file.h). If the demuxer does not number it so, as that of Matroska, it is the one at its
// place among the tracks; if that does not exist either, the one that FFmpeg ranks best, which is the largest. Returns
// null if there are no pictures.
const AVStream* pictures_of(AVFormatContext& file, const std::string& path, uint64_t track);

}  // namespace ods::av
