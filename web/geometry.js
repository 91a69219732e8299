// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers, angles and directions.
export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
export const radians = (angle) => (angle * Math.PI) / 180;
export const degrees = (angle) => (angle * 180) / Math.PI;
export const wrapDegrees = (angle) => angle - 360 * Math.floor((angle + 180) / 360); // to -180 .. 180
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// The rays (panorama.js) of a cube's faces in the order of GL (OpenGL ES 3.0, table 3.19): +X, -X, +Y, -Y, +Z, -Z.
export const FACES = [
  [0, 0, -1, 0, -1, 0, 1, 0, 0], [0, 0, 1, 0, -1, 0, -1, 0, 0], [1, 0, 0, 0, 0, 1, 0, 1, 0],
  [1, 0, 0, 0, 0, -1, 0, -1, 0], [1, 0, 0, 0, -1, 0, 0, 0, 1], [-1, 0, 0, 0, -1, 0, 0, 0, -1],
];
