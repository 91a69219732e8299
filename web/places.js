// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts between positions on the page and directions. Positions are CSS pixels from the upper left corner,
// directions have yaw and pitch in degrees.
import { degrees, dot } from './geometry.js';
import { boxOf, modeOf } from './modes.js';
import { bendOf, raysOf } from './panorama.js';

const columns = (rays) => [rays.slice(0, 3), rays.slice(3, 6), rays.slice(6, 9)];

// The parts of the view, each with its eye, its box: left, top, width, height, and its aspect as it is drawn: a canvas of
// a lower resolution has whole pixels, too.
export function partsOf({ canvas, element, state }) {
  const [wide, high] = [element.clientWidth / canvas.width, element.clientHeight / canvas.height];
  return modeOf(state.mode).parts(0).map(({ at, eye = 0 }) => {
    const [x, y, width, height] = boxOf(at, canvas);
    return { eye: state.swap ? 1 - eye : eye, aspect: width / height, box: [x * wide, (canvas.height - y - height) * high, width * wide, height * high] };
  });
}

// The direction at a position, and the eye that sees it; null outside.
export function directionAt(viewer, x, y) {
  const part = partsOf(viewer).find(({ box }) => x >= box[0] && x < box[0] + box[2] && y >= box[1] && y < box[1] + box[3]);
  if (!part) return null;
  const [left, top, width, height] = part.box;
  const [right, up, ahead] = columns(raysOf(viewer.state, part.aspect));
  const [a, b] = [(2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height];
  const aside = right.map((value, i) => a * value + b * up[i]);
  const d = ahead.map((value, i) => aside[i] + value * (1 - bendOf(viewer.state) * dot(aside, aside)));
  return { yaw: degrees(Math.atan2(d[0], -d[2])), pitch: degrees(Math.asin(d[1] / Math.hypot(...d))), eye: part.eye ? 'right' : 'left' };
}

// The position of a direction in a part of the view; null if it is outside.
export function placeOf({ state }, { yaw, pitch }, { aspect, box: [left, top, width, height] }) {
  const axes = columns(raysOf(state, aspect));
  const d = raysOf({ yaw, pitch }, 1).slice(6, 9);
  const ahead = state.planet ? (1 + dot(d, axes[2])) / 2 : dot(d, axes[2]);
  if (ahead <= 0.01) return null;
  const [x, y] = [0, 1].map((i) => dot(d, axes[i]) / (dot(axes[i], axes[i]) * ahead));
  return Math.max(Math.abs(x), Math.abs(y)) < 1 ? [left + ((x + 1) / 2) * width, top + ((1 - y) / 2) * height] : null;
}
