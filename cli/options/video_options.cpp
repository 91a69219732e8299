// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/video_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "cli/console/console.h"
#include "cli/options/apple_option.h"
#include "cli/options/picture_options.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/lint/players.h"
#include "ods/video/tracks/sound.h"

using ods::Chroma, ods::Container, ods::Extent, ods::VideoCodec, ods::Layout;

namespace {

std::string encoder_list() {
  return fmt::format("{}", fmt::join(ods::names_of(ods::known_encoders()), ", "));
}

void parse_encoder(const std::string& name, VideoChoices& choices) {
  for (const ods::EncoderFacts& facts : ods::known_encoders()) {
    if (facts.name != name) continue;
    choices.encoder = name;
    return;
  }
  throw UsageError(fmt::format("--encoder is one of {}, not '{}'", encoder_list(), name));
}

// The target's packing, with the options applied.
ods::Packing packing_for(const VideoChoices& choices, Container container, Extent size) {
  ods::Packing packing = ods::packing_for(choices.target_or_usual(), size, choices.rate.value());
  const auto change = [&](VideoCodec codec) {
    if (packing.codec == codec) return;
    packing.codec = codec;
    packing.quality.reset();
    if (codec == VideoCodec::kProRes) packing.bits = 10, packing.chroma = Chroma::k422;
  };
  if (choices.codec) {
    change(*choices.codec);
  } else if (!choices.encoder.empty()) {
    for (const ods::EncoderFacts& facts : ods::known_encoders()) {
      if (facts.name == choices.encoder) change(facts.codec);
    }
  } else if (container == Container::kWebm && choices.target_or_usual() != ods::VideoTarget::kMaster) {
    change(VideoCodec::kVp9);
  }
  packing.bits = choices.bits.value_or(packing.bits);
  packing.chroma = choices.chroma.value_or(packing.chroma);
  if (choices.crf) packing.quality = choices.crf;
  return packing;
}

void check_container(Container container, VideoCodec codec) {
  if (ods::can_hold(container, codec)) return;
  std::vector<std::string_view> codecs, containers;
  for (VideoCodec each : ods::kVideoCodecs) {
    if (ods::can_hold(container, each)) codecs.push_back(ods::video_codec_name(each));
  }
  for (Container each : ods::containers_of(codec)) containers.push_back(ods::container_name(each));
  throw UsageError(fmt::format("{} holds {}, not {}, which goes into {}", ods::container_name(container),
                               fmt::join(codecs, ", "), ods::video_codec_name(codec), fmt::join(containers, ", ")));
}

void check_quality(const ods::EncodeOptions& options) {
  const ods::Packing& packing = options.packing;
  const std::string_view codec = ods::video_codec_name(packing.codec);
  if (!ods::can_have(packing.codec, packing.bits, packing.chroma)) {
    throw UsageError(
        fmt::format("there is no {} of {} bits and chroma {}", codec, packing.bits, ods::chroma_name(packing.chroma)));
  }
  for (const ods::EncoderFacts& facts : ods::known_encoders()) {
    if (facts.codec != packing.codec) continue;
    if (!options.encoder.empty() && options.encoder != facts.name) continue;
    const bool has_choice = packing.quality || options.bitrate || !options.preset.empty();
    if (facts.worst_quality == 0 && has_choice) {
      throw UsageError(fmt::format("{} has no --crf, --bitrate or --preset", codec));
    }
    if (packing.quality && *packing.quality > facts.worst_quality) {
      throw UsageError(fmt::format("--crf of {} is from 0, the best, to {}", codec, facts.worst_quality));
    }
    return;
  }
  throw UsageError(fmt::format("{} does not encode {}", options.encoder, codec));
}

// Warns about a video that does not exist yet, as ods probe would see it, and notes the name by which players would
// recognise it.
void warn_of_names(const VideoChoices& choices, const ods::VideoPlan& plan) {
  ods::VideoFile video;
  ods::VideoTrack track;
  track.size = plan.size;
  track.v2 = track.v1 = plan.metadata;
  for (const std::string& warning : ods::video_warnings(video, track, choices.output)) warn(warning);
  const bool has_words = plan.eyes == 1 || !ods::read_name(choices.output).layout_token.empty();
  if (has_words && !ods::name_misleads(video, track, choices.output)) return;
  std::string words = plan.metadata.is_partial() ? "_180" : "_360";
  if (!plan.metadata.projection || plan.metadata.projection == ods::VideoProjection::kFlat) words = "";
  if (plan.eyes == 2) words += plan.metadata.stereo == ods::VideoStereo::kSideBySide ? "_LR" : "_TB";
  const std::string name = std::filesystem::path(ods::renamed(choices.output, words)).filename().native();
  if (name == std::filesystem::path(choices.output).filename().native()) return;
  note(fmt::format("players that rely on the file name would recognise {}", name));
}

void warn_of_level(const ods::VideoPlan& plan, const ods::EncodeOptions& options) {
  const std::optional<ods::Codec> codec = ods::level_codec(options.packing.codec);
  const double fps = options.rate.value();
  if (!codec || !ods::smallest_level(*codec, plan.size, fps).empty()) return;
  const std::optional<Extent> largest = ods::largest_in_levels(*codec, plan.size, fps);
  warn(fmt::format("no level of {} holds {}x{} at {:.4g} frames a second: many players will refuse it{}",
                   ods::codec_name(*codec), plan.size.width, plan.size.height, fps,
                   largest ? fmt::format("; the largest is {}x{}", largest->width, largest->height) : ""));
}

void warn_of_hardware(const ods::Packing& packing) {
  if (packing.codec == VideoCodec::kProRes) return;
  if (packing.chroma != Chroma::k420 || (packing.codec == VideoCodec::kH264 && packing.bits > 8)) {
    warn(fmt::format("few players accept {} of {} bits and chroma {}", ods::video_codec_name(packing.codec),
                     packing.bits, ods::chroma_name(packing.chroma)));
  }
}

}  // namespace

Container container_for(const std::string& path) {
  if (path.empty()) throw UsageError("no output file: add -o video.mp4");
  if (const std::optional<Container> container = ods::container_of_path(path)) return *container;
  throw UsageError(fmt::format("'{}' is not the name of a video, which ends in .mp4, .mov, .mkv or .webm", path));
}

ods::FrameRate parse_rate(const std::string& text) {
  const size_t stroke = text.find('/');
  const std::vector<float> parts = parse_numbers(text.substr(0, stroke));
  const std::vector<float> below =
      stroke == std::string::npos ? std::vector<float>{1.0f} : parse_numbers(text.substr(stroke + 1));
  const auto thousandths = [](float value) { return std::lround(std::clamp(value, 0.0f, 2e5f) * 1000.0f); };
  if (parts.size() != 1 || below.size() != 1 || thousandths(parts[0]) < 1 || thousandths(below[0]) < 1) {
    throw UsageError(fmt::format("--fps is a number or a fraction, as 30, 29.97 or 30000/1001, not '{}'", text));
  }
  long count = thousandths(parts[0]), seconds = thousandths(below[0]);
  for (long whole : {24, 30, 48, 60, 120}) {
    if (seconds == 1000 && std::abs(count * 1001 - whole * 1000 * 1000) < 1000) count = whole * 1000, seconds = 1001;
  }
  const long common = std::gcd(count, seconds);
  const ods::FrameRate rate{static_cast<int>(count / common), static_cast<int>(seconds / common)};
  if (rate.value() < 0.1 || rate.value() > 1000.0) throw UsageError("--fps is from 0.1 to 1000");
  return rate;
}

void add_video_options(Options& options, VideoChoices& choices) {
  options.group("Video");
  options.text("-o,--output", ValueKind::output_file(), choices.output, ".mp4 .mov .mkv .webm");
  add_packing_options(options, choices);
}

void add_packing_options(Options& options, VideoChoices& choices) {
  options.choice("--target", choices.target, ods::kVideoTargetTable,
                 "preset for a destination; the options below override it",
                 std::string(ods::name_in(ods::kVideoTargetTable, ods::VideoTarget::kVrPlayers)));
  options.choice("--codec", choices.codec, ods::kVideoCodecTable, "video codec; by default the target's");
  options.custom(
      "--encoder", "NAME", "", [&](const std::string& name) { parse_encoder(name, choices); },
      "encoder for the codec: " + encoder_list());
  options.text("--preset", "NAME", choices.preset, "the encoder's own preset name, e.g. slow");
  options.number("--crf", choices.crf, 0, 63,
                 "quality, lower is better; by default 18 for h264, 20 for hevc, 28 for av1, 24 for vp9");
  options.number("--bitrate", choices.bitrate, 0.01f, 10000.0f, "bit rate in Mbit/s, instead of --crf");
  options.number("--bits", choices.bits, 8, 10, "bits per channel: 8 or 10");
  options.choice("--chroma", choices.chroma, ods::kChromaTable, "chroma subsampling");
  options.text("--audio", ValueKind::input_file(), choices.sound,
               "sound file: mono, stereo, or first-order ambisonics with four channels (AmbiX)");
  add_apple_option(options, choices.for_apple);
}

// A codec that cannot be written, or not into this container, is replaced by a codec for players.
static void warn_of_less(const VideoChoices& choices, const std::string& path, const ods::VideoStream& stream) {
  std::string loss, remedy;
  if (stream.bits > 8 && !choices.bits && !stream.words.is_hdr()) {
    loss += fmt::format(" {} bits", stream.bits), remedy += " --bits 10";
  }
  if (stream.chroma != ods::Chroma::k420 && !choices.chroma) {
    loss += fmt::format(" chroma {}", ods::chroma_name(stream.chroma));
    remedy += fmt::format(" --chroma {}", ods::chroma_name(stream.chroma));
  }
  if (!loss.empty())
    warn(fmt::format("'{}' has{}; the new video has less, for compatibility with players:{} keeps it", path, loss,
                     remedy));
}

VideoChoices choices_like(VideoChoices choices, const ods::VideoInput& video, const ods::VideoStream& stream) {
  choices.rate = stream.rate;
  const auto own = ods::packing_like(stream, container_for(choices.output));
  const bool follows_input = !choices.target && !choices.codec && choices.encoder.empty();
  if (own && follows_input) {
    choices.codec = own->codec;
    choices.bits = choices.bits.value_or(own->bits);
    choices.chroma = choices.chroma.value_or(own->chroma);
  } else if (follows_input) {
    warn_of_less(choices, video.path, stream);
  }
  choices.keep.path = video.path;
  choices.keep.track = video.track;
  choices.keep.joined = video.other_track;
  choices.keep.has_sound = choices.sound.empty();
  choices.keep.tell = [path = video.path](const std::string& words) { warn(fmt::format("'{}': {}", path, words)); };
  return choices;
}

ods::EncodeOptions encode_options(const VideoChoices& choices, Extent size, int threads) {
  const Container container = container_for(choices.output);
  check_apple(choices.for_apple, container);
  setenv("SVT_LOG", "0", 0);  // SVT-AV1 would print its own messages
  ods::EncodeOptions options;
  options.packing = packing_for(choices, container, size);
  options.encoder = choices.encoder;
  options.preset = choices.preset;
  if (choices.bitrate) options.bitrate = static_cast<double>(*choices.bitrate);
  options.rate = choices.rate;
  options.threads = threads;
  options.sound = choices.sound;
  options.keep = choices.keep;
  options.for_apple = choices.for_apple;
  check_container(container, options.packing.codec);
  check_quality(options);
  ods::check_encoder(container, options);
  ods::check_writable(choices.output);
  return options;
}

ods::VideoPlan expect_video(Layout layout, size_t eyes, ods::Extent eye, const ods::ProjectionSetting& projection) {
  const ods::EyeArrangement shared = ods::arrangement_of(layout);
  if (eyes == 2 && (!shared.is_halves() || shared.right_first)) {
    throw UsageError(fmt::format("a video's layout is top-bottom or side-by-side, possibly -half, not {}",
                                 ods::layout_name(layout)));
  }
  const ods::VideoPlan plan =
      ods::plan_eyes(ods::squeezed_eye(layout, eye, static_cast<int>(eyes)), eyes, layout, projection);
  for (const std::string& each : plan.notes) warn(each);
  return plan;
}

void note_player_limits(const VideoChoices& choices, const ods::VideoPlan& plan, const ods::EncodeOptions& options) {
  warn_of_level(plan, options);
  warn_of_hardware(options.packing);
  warn_of_names(choices, plan);
}

void note_sound_length(const ods::EncodeOptions& options, size_t frames) {
  if (options.sound.empty()) return;
  const double frame = 1.0 / options.rate.value(), video = static_cast<double>(frames) * frame;
  const ods::SoundInfo sound = ods::read_sound_info(options.sound);
  if (sound.channels == 4) note("the sound is taken as first-order ambisonics (AmbiX: W Y Z X, SN3D)");
  if (sound.seconds > video + frame) {
    note(fmt::format("the sound, {:.1f} s, is cut where the pictures end, at {:.1f} s", sound.seconds, video));
  } else if (sound.seconds > 0.0 && sound.seconds < video - frame) {
    warn(fmt::format("the sound ends at {:.1f} s, the pictures at {:.1f} s", sound.seconds, video));
  }
}

std::string video_text(const ods::VideoPlan& plan, const ods::EncodeOptions& options, size_t frames) {
  const std::optional<ods::Codec> codec = ods::level_codec(options.packing.codec);
  const std::string_view level =
      codec ? ods::smallest_level(*codec, plan.size, options.rate.value()) : std::string_view();
  return fmt::format("{}, {} bits, {}{}, {}x{}, {} frame{} at {:.4g} a second",
                     ods::video_codec_name(options.packing.codec), options.packing.bits,
                     ods::chroma_name(options.packing.chroma), level.empty() ? "" : fmt::format(", level {}", level),
                     plan.size.width, plan.size.height, frames, frames == 1 ? "" : "s", options.rate.value());
}
