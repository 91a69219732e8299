// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The format of a file: the layout of its eyes, and their camera.
import { LAYOUTS, PROJECTIONS } from './formats.js';

const named = (rows, name) => rows.find((row) => row.name === name);

// The format of an item that the page uses: the file's own, or the one that the user chose.
export function formOf(item, { layout, projection } = {}) {
  const rows = named(LAYOUTS, layout) ?? named(LAYOUTS, item.light_layout ?? item.layout);
  const own = item.camera ?? named(PROJECTIONS, item.projection)?.camera;
  return {
    layout: rows ?? { left: [0, 0, 1, 1], right: [0, 0, 1, 1] },
    camera: named(PROJECTIONS, projection)?.camera ?? own ?? PROJECTIONS[0].camera,
  };
}

// Returns whether both eyes share a file, for which other layouts can be tried: by the page, or by a server that
// divides it.
export function hasOtherLayouts(view, item) {
  return Boolean(item.image) || ((view.live || item.light) && item.kind === 'picture' && !['separate', 'multiview'].includes(item.layout));
}

// Kinds of ods/kernel/camera/projection.h: a lat-long and a cylinder have a span, in radians; the cubes are all around,
// and have columns of faces.
const hasSpan = ({ kind }) => kind < 2;
const COLUMNS = { 5: 3, 6: 6, 7: 1, 8: 3 };

// Returns whether the right edge of a picture continues at its left one.
export function isRound({ projection }) {
  return hasSpan(projection) && projection.span[0] > 2 * Math.PI - 1e-4;
}

// Returns the horizontal angle of a picture, radians.
export function angleOf({ projection }) {
  if (hasSpan(projection)) return projection.span[0];
  return projection.kind in COLUMNS ? 2 * Math.PI : projection.angle;
}

// Returns the angle of a texel in the middle of an eye's picture of a width, radians.
export function texelAngle(camera, width) {
  const columns = COLUMNS[camera.projection.kind];
  return (columns ? (columns * Math.PI) / 2 : angleOf(camera)) / width;
}

// Fractions of a file -> whole pixels.
export function cropOf([x, y, width, height], file) {
  const [left, top] = [Math.round(x * file.width), Math.round(y * file.height)];
  return [left, top, Math.round((x + width) * file.width) - left, Math.round((y + height) * file.height) - top];
}

export const same = (a, b) => a.every((value, i) => value === b[i]);
