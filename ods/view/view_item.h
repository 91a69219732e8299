// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures and videos as the viewer's page shows them: a file that browsers read, or a JPEG of each eye, and what the
// page's shader needs to know of the camera. docs/view.md describes view.json.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/base/json_reader.h"
#include "ods/image/tone.h"
#include "ods/picture/stored_picture.h"
#include "ods/view/beside.h"

namespace ods {

struct ViewItem {
  std::string path;
  std::string name;  // for people: the file's name without its folder
  bool is_video = false;
  bool is_light = false;      // scene-linear: shown with an exposure and a tone curve
  bool has_own_file = false;  // browsers read the file itself and divide it into eyes; else each eye is sent as a JPEG
  FormatHint known;           // what the caller knew of it
  StoredPicture picture;      // its header, without pixels
  double fps = 0.0;           // of a video; 0: unknown
  bool is_ambisonic = false;  // a video's sound: first order, AmbiX
  Notes notes;
  std::string subtitles;  // of a video: WebVTT
};

// Finds out what a file shows, as `ods convert` would read it. Throws Error(kInput) as open_picture() and open_video();
// also for a format of browsers that holds no picture.
ViewItem open_view_item(const std::string& path, const FormatHint& known = {});

// The page's view.json: items, and the layouts, projections and tone curves that they can be changed to.
// is_live: eyes are sent by a server, which can develop them again. studio: of the studio, or null.
std::string view_json(std::span<const ViewItem> items, bool is_live, const Json& studio);

// The name under which view.json refers to a file of an item, relative to itself: item/0/NAME.
std::string item_file(size_t index, std::string_view name);
inline constexpr std::string_view kPreviewFile = "preview.jpg", kThumbnailFile = "thumbnail.jpg",
                                  kLightFile = "light.png", kPosterFile = "poster.jpg";

// Likewise the names of what an item shows: item/0/picture.png, or item/0/left.jpg and item/0/right.jpg.
std::vector<std::string> item_files(const ViewItem& item, size_t index);

constexpr int kPreviewWidth = 1024, kThumbnailWidth = 256;  // pixels of an eye, up to twice as many

// Whether there is a preview, which view.json names: a small copy of a file that browsers read, both eyes as they are.
// is_live: as view_json().
bool has_preview(const ViewItem& item, bool is_live);

// A picture's pixels; a video's first picture. Throws Error(kInput).
StoredPicture open_shown(const ViewItem& item);

// As JPEGs: the preview, and a small left eye of any item, of a video its first picture. Throw Error(kInput) where the
// file cannot be read, and as eye_jpeg().
std::string preview_jpeg(const ViewItem& item);
std::string thumbnail_jpeg(const ViewItem& item);

// Whether an item's light is sent as it is, and what is sent: a PNG of both eyes, twice as wide. Its left half has the
// high bytes of the halves of R, G and B, its right half the low ones. The eyes are as view.json's "light_layout" says.
bool has_light(const ViewItem& item);
std::string light_png(const StoredPicture& picture);

struct EyeOptions {
  float exposure = 0.0f;  // stops, and with the tone curve only for scene-linear pictures
  ToneCurve tone = ToneCurve::kNeutral;
  int most_wide = 0;  // pixels; 0: as the picture has it
};

// One eye (kLeft, kRight, kMono) as a JPEG. The picture has its pixels. Throws Error(kUsage) if it is too large for one.
std::string eye_jpeg(const StoredPicture& picture, int eye, const EyeOptions& options);

// What one eye sees straight ahead, 960 pixels wide, as a JPEG: for pages until the picture is there.
std::string poster_jpeg(const StoredPicture& picture);

}  // namespace ods
