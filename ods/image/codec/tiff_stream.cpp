// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/codec/tiff_stream.h"

#include <tiffio.h>

#include <cstdarg>
#include <cstdio>
#include <new>

namespace ods {

namespace {

// Keeps the first message, which is the cause of later ones. Called by C, so it must not throw.
int keep_message(TIFF*, void* to, const char*, const char* format, std::va_list values) {
  TiffStream& stream = *static_cast<TiffStream*>(to);
  if (stream.words[0] == '\0') std::vsnprintf(stream.words, sizeof stream.words, format, values);
  return 1;  // suppresses libtiff's own handler
}

int ignore_message(TIFF*, void*, const char*, const char*, std::va_list) {
  return 1;
}

tmsize_t read_stream(thandle_t handle, void* to, tmsize_t count) {
  return static_cast<tmsize_t>(static_cast<TiffStream*>(handle)->read(to, static_cast<size_t>(count)));
}

tmsize_t write_stream(thandle_t handle, void* from, tmsize_t count) {
  static_cast<TiffStream*>(handle)->write(from, static_cast<size_t>(count));
  return count;
}

toff_t seek_stream(thandle_t handle, toff_t to, int from) {
  TiffStream& stream = *static_cast<TiffStream*>(handle);
  return stream.at = from == SEEK_SET ? to : from == SEEK_CUR ? stream.at + to : stream.size() + to;
}

toff_t size_of_stream(thandle_t handle) {
  return static_cast<TiffStream*>(handle)->size();
}

}  // namespace

void TiffCloser::operator()(tiff* handle) const {
  TIFFClose(handle);
}

TiffHandle open_tiff_handle(TiffStream& stream, const std::string& name, const char* mode, uint64_t maximum) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  if (!options) throw std::bad_alloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &stream);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_message, nullptr);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(maximum));
  const auto close = [](thandle_t) { return 0; };
  return TiffHandle(TIFFClientOpenExt(name.c_str(), mode, &stream, read_stream, write_stream, seek_stream, close,
                                      size_of_stream, nullptr, nullptr, options.get()));
}

}  // namespace ods
