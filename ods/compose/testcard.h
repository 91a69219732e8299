// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A card that shows at a glance whether a player interprets a stereo 360 picture correctly: which eye sees which half,
// degrees, poles, the seam, safe and unsafe depth steps, roundness, greys and single pixels.
//
// The card is a world of flat cards around the camera, at their own distances, drawn along the camera's rays, so it is
// exact in every projection, merge and convergence. Edges are antialiased analytically.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/stroke_font.h"

namespace ods {

enum class CardPattern {
  kPlate,  // a dark plate with a border, for lettering
  kRing,   // a circle as wide as the card: round if the player preserves shapes
  kStar,   // spokes: blur or double images turn them grey from the centre
  kBars,   // `pixels` bright, then as many dark picture pixels; vertical bars in the upper half, horizontal below
  kGreys,  // eleven steps of display code values; the first and last contain a patch that differs by 4 of 255
  kCells,  // `count` dark cells in a row; number `lit` is white
  kSweep,  // a white bar on black: left edge at `phase` 0, right edge at 1
};

// A card is centred on `middle`, seen from the centre of the viewing circle; `half` is its half size, as tangents.
struct Card {
  CardPattern pattern = CardPattern::kPlate;
  vec3 middle, right, up;
  float inverse_depth = 0.0f;  // 1 / metres; 0 at infinity
  vec2 half{0.0f};
  float reach = -1.0f;  // cosine of the largest angle between its centre and a ray that hits it
  vec3 color{1.0f};
  int pixels = 0;
  int count = 1, lit = -1;
  float phase = 0.0f;
  int eye = kMono;  // kLeft, kRight if the lettering is visible to this eye only
  std::vector<Stroke> strokes;
  float stroke = 0.0f;  // half the stroke width
};

struct Testcard {
  Camera camera;
  Extent eye;
  std::vector<Card> cards;  // in painting order, the closest last
};

// The camera is at the origin of the card's world, regardless of its position. `lines` are written above the centre.
// Preconditions: those of make_camera(); sides above 0.
Testcard make_testcard(const StereoCamera& stereo, Extent eye, const std::vector<std::string>& lines);

// The height in pixels of the small plates' capitals in such a picture; below kLegible they are illegible.
double letter_height(const ProjectionSetting& projection, int width);
inline constexpr double kLegible = 6.0;

// Fills row y of one eye with linear R, G, B; black outside the projection.
void fill_testcard_row(const Testcard& card, int eye, int y, std::span<float> row);

// Fills `row` with the pixels from column `first` on.
void fill_testcard_pixels(const Testcard& card, int eye, int first, int y, std::span<float> row);

// The moving marks of a video's card, in four directions, half way down: the frame number for each eye (L 0123, R
// 0123); a row of cells, one per frame of a second (at most 60), with the current one lit; a bar that crosses in one
// second; and a flash at the start of every second. The marks are at the same places in every frame.
std::vector<Card> testcard_marks(const StereoCamera& stereo, Extent eye, int frame, double fps);

// The first frame of a second of the video, and the flash's length in frames.
int first_frame_of(int second, double fps);
int flash_frames(double fps);

// Returns whether a ray hits a card or passes within `margin` radians of its border. Precondition: a card at infinity.
bool is_on_card(const Card& card, vec3 direction, float margin);

// Computes Card::reach of all cards.
void set_reach(std::vector<Card>& cards, const StereoCamera& stereo, Extent eye);

}  // namespace ods
