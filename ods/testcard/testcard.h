// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A card that shows in one look whether a player takes a stereo 360 picture for what it is: which eye sees which half,
// degrees, poles, the seam, steps of depth and which of them are safe, roundness, greys, and single pixels.
//
// It is a world of flat cards about the camera, at their distances, and is drawn along the camera's own rays: exact in
// every projection, merge and convergence. Edges are antialiased by their distance in pixels.
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
  kRing,   // a circle as wide as the card: round, where the player keeps the shape
  kStar,   // spokes: what is blurred or doubled goes grey from the middle
  kBars,   // `pixels` bright, then as many dark, of the picture itself; the upper half upright, the lower level
  kGreys,  // eleven steps of the display's code, the first and last with a patch that differs by 4 of 255
  kCells,  // `count` dark ones beside each other, of which that number `lit` is white
  kSweep,  // a white bar on black: at the left with `phase` 0, at the right with 1
};

// Seen from the middle of the viewing circle a card lies about `middle`, `half` wide and high as tangents.
struct Card {
  CardPattern pattern = CardPattern::kPlate;
  vec3 middle, right, up;
  float inverse_depth = 0.0f;  // 1 / metres; 0: at infinity
  vec2 half{0.0f};
  float reach = -1.0f;  // cosine of the angle from its middle that no ray to it exceeds
  vec3 color{1.0f};
  int pixels = 0;
  int count = 1, lit = -1;
  float phase = 0.0f;
  int eye = kMono;  // kLeft, kRight: the lettering is for this eye alone
  std::vector<Stroke> strokes;
  float stroke = 0.0f;  // half the thickness
};

struct Testcard {
  Camera camera;
  Extent eye;
  std::vector<Card> cards;  // the nearest last
};

// The camera is at the centre of the card's world, whatever its position. `lines` are lettered above the middle.
// Precondition: as of make_camera(); sides above 0.
Testcard make_testcard(const StereoCamera& stereo, Extent eye, const std::vector<std::string>& lines);

// How high the capitals of the small plates are in such a picture, pixels; below kLegible they cannot be read.
double letter_height(const ProjectionSetting& projection, int width);
inline constexpr double kLegible = 6.0;

// Row y of one eye: R, G, B of every pixel, linear; black where the projection is empty.
void fill_testcard_row(const Testcard& card, int eye, int y, std::span<float> row);

// The pixels from column `first` on, as many as `row` has room for.
void fill_testcard_pixels(const Testcard& card, int eye, int first, int y, std::span<float> row);

// What moves on the card of a video: in four directions, half way down, the number of the frame for each eye (L 0123, R
// 0123), as many cells as there are frames a second (at most 60), of which the frame's is lit, a bar that crosses in a
// second, and a flash with which every second begins. The cards stand in the same places in every frame.
std::vector<Card> testcard_marks(const StereoCamera& stereo, Extent eye, int frame, double fps);

// The frame with which a second of the video begins, and for how many the flash is seen.
int first_frame_of(int second, double fps);
int flash_frames(double fps);

// Whether a ray meets a card, or passes within `margin` radians of its border. Precondition: a card at infinity.
bool is_on_card(const Card& card, vec3 direction, float margin);

// Fills in how far from their middles cards are seen.
void set_reach(std::vector<Card>& cards, const StereoCamera& stereo, Extent eye);

}  // namespace ods
