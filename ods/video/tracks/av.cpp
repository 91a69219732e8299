// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/av.h"

#include <fmt/format.h>

#include <cstdio>
#include <mutex>
#include <utility>
#include <vector>

#include "ods/base/text.h"
#include "ods/files/read_file.h"
#include "ods/video/container/video_file.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/audio_fifo.h>
#include <libswresample/swresample.h>
}

namespace ods::av {

void Free::operator()(AVCodecContext* context) const {
  avcodec_free_context(&context);
}
void Free::operator()(AVFrame* frame) const {
  av_frame_free(&frame);
}
void Free::operator()(AVPacket* packet) const {
  av_packet_free(&packet);
}
void Free::operator()(SwrContext* context) const {
  swr_free(&context);
}
void Free::operator()(AVAudioFifo* fifo) const {
  av_audio_fifo_free(fifo);
}
void Free::operator()(AVFormatContext* context) const {
  if (context->iformat != nullptr) return avformat_close_input(&context);
  avio_closep(&context->pb);
  avformat_free_context(context);
}

// The library's last log message, captured instead of printed. Without the sender's name and address, so that the same
// error gives the same text.
static std::mutex complaint_mutex;
static std::string complaint;

static void listen(void*, int level, const char* format, va_list words) {
  if (level > AV_LOG_ERROR) return;
  char line[512];
  std::vsnprintf(line, sizeof(line), format, words);
  const std::lock_guard<std::mutex> lock(complaint_mutex);
  complaint = std::string(line);
}

void keep_complaints() {
  const std::lock_guard<std::mutex> lock(complaint_mutex);
  complaint.clear();
  av_log_set_callback(listen);
}

// FFmpeg's own text for its error codes is not helpful ("Not yet implemented in FFmpeg, patches welcome").
static std::string reason_of(int code) {
  constexpr int kLastSystemError = -4095;  // smaller values are FFmpeg's own
  switch (code) {
    case AVERROR_INVALIDDATA:
      return "it is damaged, or in a format that FFmpeg does not support";
    case AVERROR_EOF:
      return "it ends too early";
    case AVERROR_STREAM_NOT_FOUND:
      return "it has no such stream";
    case AVERROR_DECODER_NOT_FOUND:
      return "this machine's FFmpeg has no decoder for it; convert it to another format first";
    case AVERROR_PATCHWELCOME:
    case AVERROR(ENOSYS):
    case AVERROR(EINVAL):
      return "this machine's FFmpeg does not support that; try another codec, format or size, or a newer FFmpeg";
    case AVERROR_BUG:
    case AVERROR_BUG2:
    case AVERROR_UNKNOWN:
      return "FFmpeg failed without a reason; try another codec or format, or a newer FFmpeg";
    default:
      break;
  }
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  if (code >= kLastSystemError) return text;
  return fmt::format("FFmpeg failed ({}); try another codec or format, or a newer FFmpeg", text);
}

static std::string words_for(int code) {
  const std::lock_guard<std::mutex> lock(complaint_mutex);
  const std::string said = std::exchange(complaint, "");
  return said.empty() ? reason_of(code) : fmt::format("{} (FFmpeg: {})", reason_of(code), one_line(said));
}

int checked(int code, ErrorKind kind, const std::string& what) {
  if (code >= 0) return code;
  if (code == AVERROR(ENOMEM)) kind = ErrorKind::kMemory;
  throw Error(kind, fmt::format("{}: {}", what, words_for(code)));
}

int checked_small_input(int code, const std::string& what) {
  if (code >= 0) return code;
  throw Error(ErrorKind::kInput, fmt::format("{}: {}", what, words_for(code)));
}

// Formats of one file, by FFmpeg's names. Others are lists that name files, which FFmpeg would read from anywhere: HLS,
// DASH, IMF, concat.
static constexpr const char* kFormats =
    "mov,matroska,avi,asf,mpeg,mpegts,wav,w64,aiff,caf,au,flac,ogg,mp3,aac,ac3,eac3,truehd,dts,wv,tta,ape,amr,tak,voc";

Owned<AVFormatContext> open_file(const std::string& path, const std::string& what) {
  keep_complaints();
  static_cast<void>(file_size(path));  // throws if it is not a regular file
  AVFormatContext* file = nullptr;
  AVDictionary* only_files = nullptr;
  av_dict_set(&only_files, "protocol_whitelist", "file", 0);
  av_dict_set(&only_files, "format_whitelist", kFormats, 0);
  const int opened = avformat_open_input(&file, ("file:" + path).c_str(), nullptr, &only_files);
  av_dict_free(&only_files);
  if (opened == AVERROR(EINVAL)) {  // FFmpeg's code for a format that is not on the list
    keep_complaints();              // without the list, which FFmpeg logs
    throw Error(ErrorKind::kInput,
                fmt::format("{}: it is not a sound or video file of a kind that is read here", what));
  }
  checked_small_input(opened, what);
  Owned<AVFormatContext> owned(file);
  checked_small_input(avformat_find_stream_info(file, nullptr), what);
  return owned;
}

const AVStream* pictures_of(AVFormatContext& file, const std::string& path, uint64_t track) {
  std::vector<const AVStream*> all;
  for (unsigned i = 0; i < file.nb_streams; i++) {
    const AVStream* each = file.streams[i];
    if (each->codecpar->codec_type != AVMEDIA_TYPE_VIDEO) continue;
    if (static_cast<uint64_t>(each->id) == track) return each;
    if ((each->disposition & AV_DISPOSITION_ATTACHED_PIC) == 0) all.push_back(each);
  }
  const std::vector<VideoTrack> tracks = all.size() > 1 ? read_video_file(path).tracks : std::vector<VideoTrack>();
  for (size_t i = 0; i < tracks.size() && tracks.size() == all.size(); i++) {
    if (tracks[i].id == track) return all[i];
  }
  const int best = av_find_best_stream(&file, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  return best < 0 ? nullptr : file.streams[best];
}

}  // namespace ods::av
