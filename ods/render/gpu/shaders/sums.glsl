// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Adds finished paths to the planes of PictureSamples, as ods/render/cpu/render.cpp does: whole numbers, so that the
// order does not matter. Only the light of a pixel and its weights may be added to from two slots at once.
const float kLightUnits = 16777216.0;        // kLightUnit
const float kBrightest = 524288.0;           // kBrightestSample
const float kWeightUnits = 1024.0;           // kWeightUnit
const float kWordUnits = 4294967296.0;       // 2^32

// Light in its unit; NaN counts as 0. A float times a power of two is exact, so this is the whole number that the CPU
// finds.
float light_units(float light) {
  return light > 0.0 ? roundEven(min(light, kBrightest) * kLightUnits) : 0.0;
}

// A whole number that is at least 0, as two words, the low one first.
uvec2 words_of(float whole) {
  float high = floor(whole * (1.0 / kWordUnits));
  return uvec2(uint(whole - high * kWordUnits), uint(high));
}

// Two additions of 32 bits, because not every device has those of 64.
void add_atomically(Words plane, int at, float whole) {
  uvec2 words = words_of(whole);
  if (words == uvec2(0u)) return;
  uint before = atomicAdd(plane.at[2 * at], words.x);
  uint high = words.y + (before + words.x < before ? 1u : 0u);
  if (high > 0u) atomicAdd(plane.at[2 * at + 1], high);
}

void add_alone(Words plane, int at, float whole) {
  uvec2 words = words_of(whole);
  uint before = plane.at[2 * at];
  uint low = before + words.x;
  plane.at[2 * at] = low;
  plane.at[2 * at + 1] += words.y + (low < before ? 1u : 0u);
}

// Adds to a sum that is a pair of floats: Knuth's two-sum keeps what rounding loses.
void add_square(Floats plane, int at, float light) {
  precise float square = light * light;
  precise float before = plane.at[2 * at];
  precise float sum = before + square;
  precise float part = sum - before;
  precise float lost = (before - (sum - part)) + (square - part);
  plane.at[2 * at] = sum;
  plane.at[2 * at + 1] += lost;
}

uint weight_units(float weight) {
  return uint(roundEven(weight * weight * kWeightUnits));
}

// Adds the light that a path found for the other eye's pixel.
void add_shared(int pixel) {
  for (int c = 0; c < 3; c++) add_atomically(gpu_view.light, 3 * pixel + c, light_units(path.other_radiance[c]));
  if (gpu_view.has_alone == 1) atomicAdd(gpu_view.weights.at[pixel], weight_units(1.0 - path.own_share));
}

// Adds the light that a path found for its own pixel.
void add_own(int pixel) {
  if (gpu_view.is_transparent == 1 && path.depth < 0.0) return;
  if (kHasCatchers && path.caught) {
    gpu_view.caught.at[pixel] += 1u;
    add_alone(gpu_view.light_with, pixel, light_units(path.light_with));
    add_alone(gpu_view.light_without, pixel, light_units(path.light_without));
    return;
  }
  if (gpu_view.has_hits == 1) gpu_view.hits.at[pixel] += 1u;
  bool alone = gpu_view.has_alone == 1;
  for (int c = 0; c < 3; c++) {
    add_atomically(gpu_view.light, 3 * pixel + c, light_units(path.radiance[c]));
    float unshared = light_units(alone ? path.alone_radiance[c] : path.radiance[c]);
    if (gpu_view.has_squares == 1) add_square(gpu_view.squares, 3 * pixel + c, unshared * (1.0 / kLightUnits));
    if (alone) add_alone(gpu_view.alone, 3 * pixel + c, unshared);
    if (gpu_view.has_layers == 0) continue;
    gpu_view.normal.at[3 * pixel + c] += int(roundEven(path.normal[c] * gpu_view.layer_unit));
    gpu_view.albedo.at[3 * pixel + c] += int(roundEven(path.albedo[c] * gpu_view.layer_unit));
  }
  if (!alone) return;
  float whole = luminance(path.alone_radiance);
  float weight = whole > 0.0 ? min(luminance(path.radiance) / whole, 1.0) : path.own_share;
  atomicAdd(gpu_view.weights.at[pixel], weight_units(weight));
}
