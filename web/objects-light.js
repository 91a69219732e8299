// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light that a layered scene's file has for real-time objects: probes of the radiance that arrives at the points of a
// grid, each 9 coefficients of real spherical harmonics in RGB. Axes and metres are the scene's. Light is multiplied by
// the exposure of the scene's textures, so that 1 is white but for the tone curve.
import { clamp, dot } from './geometry.js';
import { check } from './meshopt.js';

const VALUES = 28; // of a probe: its weight, then the coefficients
const FLAT = 0.5; // light where the file has none
const Y0 = 0.282095;
const Y1 = 0.488603;
// The factors of the harmonics' polynomials, in the order of the coefficients, and those of a cosine lobe over pi
// (Ramamoorthi and Hanrahan 2001): irradiance over pi is the radiance of a white diffuse surface.
const FACTORS = [Y0, Y1, Y1, Y1, 1.092548, 1.092548, 0.315392, 1.092548, 0.546274];
const LOBE = [1, 2 / 3, 2 / 3, 2 / 3, 1 / 4, 1 / 4, 1 / 4, 1 / 4, 1 / 4];

const areNumbers = (list, is) => Array.isArray(list) && list.length === 3 && list.every(is);

function probesOf(glb, { origin, step, count, bufferView }) {
  const fits = areNumbers(origin, Number.isFinite) && areNumbers(step, (size) => size > 0) && areNumbers(count, (many) => Number.isInteger(many) && many > 0);
  check(fits, 'its probes are damaged');
  const bytes = glb.view(bufferView);
  const length = VALUES * count[0] * count[1] * count[2];
  check(bytes.length >= 4 * length, 'its probes are damaged');
  const values = new Float32Array(bytes.slice(0, 4 * length).buffer);
  check(values.every(Number.isFinite), 'its probes are damaged');
  return { origin, step, count, values };
}

// Returns { exposure, neutral, probes }, probes null if there are none: what the file says of its light. Throws a Fault.
export function readLight(glb) {
  const { exposure = 0, tone = 'neutral', probes } = glb.json.asset.extras.omnistereo.light ?? {};
  check(Number.isFinite(exposure), 'its probes are damaged');
  return { exposure: 2 ** exposure, neutral: tone !== 'linear', probes: probes ? probesOf(glb, probes) : null };
}

// The probes around a position with their shares of it, those of invalid ones left out.
function sharesAt({ origin, step, count, values }, at) {
  const cell = at.map((value, i) => clamp((value - origin[i]) / step[i], 0, count[i] - 1));
  const first = cell.map((value, i) => Math.min(Math.floor(value), Math.max(count[i] - 2, 0)));
  const shares = [];
  for (let corner = 0; corner < 8; corner++) {
    const place = first.map((value, i) => value + ((corner >> i) & 1));
    if (place.some((value, i) => value >= count[i])) continue;
    const number = place[0] + count[0] * (place[1] + count[1] * place[2]);
    const share = place.reduce((product, value, i) => product * (1 - Math.abs(cell[i] - value)), 1) * values[VALUES * number];
    if (share > 0) shares.push([number, share]);
  }
  return shares;
}

// The nearest probe that is valid, where those around are not.
function nearest({ origin, step, count: [wide, high], values }, at) {
  let best = [];
  let least = Infinity;
  for (let number = 0; VALUES * number < values.length; number++) {
    if (!(values[VALUES * number] > 0)) continue;
    const place = [number % wide, Math.floor(number / wide) % high, Math.floor(number / (wide * high))];
    const away = Math.hypot(...place.map((value, i) => origin[i] + step[i] * value - at[i]));
    if (away < least) [least, best] = [away, [[number, 1]]];
  }
  return best;
}

// The coefficients at a position: Float32Array of 9 x RGB.
export function lightAt({ probes, exposure }, at) {
  const sum = new Float32Array(27);
  let shares = probes ? sharesAt(probes, at) : [];
  if (probes && !shares.length) shares = nearest(probes, at);
  const whole = shares.reduce((total, [, share]) => total + share, 0);
  if (!whole) return sum.fill(FLAT / Y0, 0, 3);
  for (const [number, share] of shares) {
    for (let i = 0; i < 27; i++) sum[i] += (exposure * share * probes.values[VALUES * number + 1 + i]) / whole;
  }
  return sum;
}

// The factors of the polynomials 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2 of a direction, whose sum is the radiance
// from there, or, of a normal, that of a white diffuse surface (isLobe).
export const termsOf = (light, isLobe) => light.map((value, i) => value * FACTORS[Math.floor(i / 3)] * (isLobe ? LOBE[Math.floor(i / 3)] : 1));

// The light as one from far away and one from everywhere: `toward` the first, its irradiance `sun` of a surface that faces
// it, and the irradiance `ambient` of the second. Light from one direction has a first band that is sqrt(3) times the
// zeroth, light from everywhere has none.
export function sunOf(light) {
  const bright = (i) => dot(light.subarray(3 * i, 3 * i + 3), [0.2126, 0.7152, 0.0722]);
  const along = [bright(3), bright(1), bright(2)];
  const size = Math.hypot(...along);
  const toward = size > 1e-6 ? along.map((value) => value / size) : [0, 1, 0];
  const sun = [0, 1, 2].map((c) => {
    const first = Math.max(toward[0] * light[9 + c] + toward[1] * light[3 + c] + toward[2] * light[6 + c], 0);
    return size > 1e-6 ? Math.min(first, Math.sqrt(3) * Math.max(light[c], 0)) / Y1 : 0;
  });
  const ambient = sun.map((irradiance, c) => Math.max(Math.PI * (light[c] * Y0 - irradiance * Y0 * Y0), 1e-4));
  return { toward, sun, ambient };
}
