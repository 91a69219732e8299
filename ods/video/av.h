// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the few files share that know FFmpeg's libraries: handles that let go by themselves, and errors of one line.
#pragma once
#include <memory>
#include <new>
#include <string>

#include "ods/base/error.h"

struct AVAudioFifo;
struct AVCodecContext;
struct AVFormatContext;
struct AVFrame;
struct AVPacket;
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

// What the libraries complain of is kept for the next message, not printed.
void keep_complaints();

// Returns the code where it is well, zero and above. Throws Error: what, in the library's words; kMemory where it is
// out of memory, whatever `kind` is.
int checked(int code, ErrorKind kind, const std::string& what);

// The same while reading something that takes little memory, as a header or sound: if that runs out of memory, the file
// claims what cannot be. Throws Error(kInput).
int checked_small_input(int code, const std::string& what);

// Opens a file, and no address, and finds out what is in it. Throws Error(kInput) that starts with `what`.
Owned<AVFormatContext> open_file(const std::string& path, const std::string& what);

}  // namespace ods::av
