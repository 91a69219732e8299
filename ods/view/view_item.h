// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures, videos and layered scenes as the viewer's page shows them: a file that browsers read, or a JPEG of each
// eye, and the camera for the page's shader. docs/view.md describes view.json.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/base/json_reader.h"
#include "ods/base/names.h"
#include "ods/image/tone.h"
#include "ods/picture/stored_picture.h"
#include "ods/view/beside.h"
#include "ods/view/picture_stage.h"
#include "ods/view/placements.h"
#include "ods/view/tour.h"

namespace ods {

enum class ItemKind { kPicture, kVideo, kLayers };
inline constexpr NameRow<ItemKind> kItemKindTable[] = {
    {ItemKind::kPicture, "picture"}, {ItemKind::kVideo, "video"}, {ItemKind::kLayers, "layers"}};
static_assert(has_every_member(kItemKindTable));

// A real-time object in a layered scene, or in a picture with depth.
struct ViewObject {
  Placement placement;
  std::string name;                        // for people: the file's name without its folder
  std::shared_ptr<const std::string> glb;  // ods/view/objects/object_file.h
};

struct ViewItem {
  ItemKind kind = ItemKind::kPicture;
  std::string path;
  std::string fallback;  // of a layered scene: the path of the picture that is shown outside its box; empty for none
  std::string scene;     // of a layered scene: the name of the scene that was baked; empty if unknown
  vec3 ahead{0.0f};      // of a layered scene: the place for an object that has none
  std::vector<ViewObject> objects;  // the caller adds them, and to a picture the stage on which they are
  std::shared_ptr<const PictureStage> stage;
  std::string name;           // for people: the file's name without its folder
  std::string title;          // in a tour, instead of the name
  bool is_light = false;      // scene-linear: shown with an exposure and a tone curve
  bool has_own_file = false;  // browsers read the file itself and divide it into eyes; else each eye is sent as a JPEG
  bool is_for_apple = false;  // Apple's players show the file in stereo: a video with vexu, or a spatial photo
  FormatHint known;           // the format as far as the caller specified it
  StoredPicture picture;      // its header, or the fallback's; with its pixels only if they were decoded before and the
                              // page needs them
  double fps = 0.0;           // frame rate of a video; 0: unknown
  bool is_ambisonic = false;  // a video's sound: first order, AmbiX
  Notes notes;
  std::string subtitles;  // of a video: WebVTT
};

// Opens a file, by `reader` if it is open already. Throws Error(kInput) as open_picture() and open_video() do, for a
// browser format that contains no picture, and for a layered scene of a newer version.
ViewItem open_view_item(const std::string& path, const FormatHint& known = {},
                        std::optional<PictureReader> reader = {});

// Gives the tour's titles, texts and hotspots to its items; each item is a panorama.
void add_tour(const Tour& tour, std::span<ViewItem> items);

// Returns the page's view.json. is_live: a server sends the eyes and can develop them again. studio: the studio's
// description, or null. tour: the tour of which the items are the panoramas, or null.
std::string view_json(std::span<const ViewItem> items, bool is_live, const Json& studio, const Tour* tour = nullptr);

// The name under which view.json refers to a file of an item, relative to itself: item/0/NAME.
std::string item_file(size_t index, std::string_view name);
std::string fallback_file(const ViewItem& item, size_t index);
std::string object_file(size_t index, size_t object);
inline constexpr std::string_view kPreviewFile = "preview.jpg", kThumbnailFile = "thumbnail.jpg",
                                  kLightFile = "light.png", kPosterFile = "poster.jpg";

// The names under which view.json refers to the pictures of an item: item/0/picture.png, or item/0/left.jpg and
// item/0/right.jpg.
std::vector<std::string> item_files(const ViewItem& item, size_t index);

constexpr int kPreviewWidth = 1024, kThumbnailWidth = 256;  // pixels of an eye, up to twice as many

// The name of the file itself for the browser's own player of an item that is_for_apple: "system" of view.json.
std::string system_file(const ViewItem& item, size_t index);

// Returns whether there is a preview, which view.json names: a small copy of a file that browsers read, both eyes as
// they are. is_live: as view_json().
bool has_preview(const ViewItem& item, bool is_live);

// Returns whether there are a thumbnail and a poster: not for a layered scene without a fallback.
bool has_stills(const ViewItem& item);

// Returns a picture with its pixels, a video's first picture, or a layered scene's fallback. Throws Error(kInput).
StoredPicture open_shown(const ViewItem& item);

// Return as JPEGs the preview, and a small left eye of an item that has stills (of a video's first picture). Throw
// Error(kInput) if the file cannot be read, and as eye_jpeg() does.
std::string preview_jpeg(const ViewItem& item);
std::string thumbnail_jpeg(const ViewItem& item);

// Returns whether an item's linear light is sent unchanged, by light_png().
bool has_light(const ViewItem& item);

// Returns both eyes as a PNG, twice as wide. The left half has the high bytes of the half floats of R, G and B, the
// right half the low bytes. view.json's "light_layout" is the layout of the eyes.
std::string light_png(const StoredPicture& picture);

struct EyeOptions {
  float exposure = 0.0f;  // stops, and with the tone curve only for scene-linear pictures
  ToneCurve tone = ToneCurve::kNeutral;
  int max_width = 0;  // pixels; 0: the picture's width
};

// Returns one eye (kLeft, kRight, kMono) as a JPEG. Precondition: the picture has its pixels. Throws Error(kUsage) if
// it is too large for a JPEG.
std::string eye_jpeg(const StoredPicture& picture, int eye, const EyeOptions& options);

// Returns the view of one eye straight ahead, 960 pixels wide, as a JPEG: for pages until the picture is loaded.
std::string poster_jpeg(const StoredPicture& picture);

}  // namespace ods
