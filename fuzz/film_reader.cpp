// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the readers of films, and on tagging them: any bytes give a film or say why not; a film that was tagged
// is one again, and says what it was told to.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_film_reader
//   build/fuzz/fuzz_film_reader -max_len=8192 folder/of/small/films
#include <cstdlib>
#include <string>

#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/video/container/matroska_film.h"
#include "ods/video/container/mp4_film.h"

static void tag_and_read(const std::string& path, uint64_t track) {
  ods::FilmForm form;
  form.stereo = ods::FilmStereo::kTopBottom;
  form.projection = ods::FilmProjection::kEquirect;
  ods::AtomicFile to("/dev/shm/ods-fuzz/film");  // never committed
  const ods::FileInput file(path);
  try {
    const bool is_mp4 = ods::is_mp4(file.read(0, 16));
    is_mp4 ? tag_mp4(file, to, track, form) : tag_matroska(file, to, track, form);
  } catch (const ods::Broken&) {
    return;
  }
  const ods::FilmInfo film = ods::read_film(to.temporary());
  for (const ods::VideoTrack& video : film.video) {
    if (video.id == track && video.v2 && video.v2->stereo == form.stereo) return;
  }
  std::abort();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    const ods::FilmInfo film = ods::read_film(file.path());
    if (!film.video.empty()) tag_and_read(file.path(), film.video[0].id);
  } catch (const ods::Error&) {
  }
  return 0;
}
