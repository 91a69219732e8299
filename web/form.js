// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A file's form: where its eyes are, and with which camera.
const named = (rows, name) => rows.find((row) => row.name === name);

// What the page assumes of an item: the file's own form, or what the user chose instead.
export function formOf(view, item, { layout, projection } = {}) {
  const rows = named(view.layouts, layout) ?? named(view.layouts, item.light_layout ?? item.layout);
  const own = item.camera ?? named(view.projections, item.projection)?.camera;
  return {
    layout: rows ?? { left: [0, 0, 1, 1], right: [0, 0, 1, 1] },
    camera: named(view.projections, projection)?.camera ?? own ?? view.projections[0].camera,
  };
}

// Whether both eyes share a file, of which another layout can be tried: by the page, or by the server that divides it.
export function hasOtherLayouts(view, item) {
  return Boolean(item.image) || ((view.live || item.light) && item.kind === 'picture' && !['separate', 'multiview'].includes(item.layout));
}

// Whether the right edge of a picture continues at its left one. A lat-long or a cylinder's span is in radians.
export function isRound({ projection }) {
  return projection.kind < 2 && projection.span[0] > 2 * Math.PI - 1e-4;
}

// Fractions of a file -> whole pixels.
export function cropOf([x, y, width, height], file) {
  const [left, top] = [Math.round(x * file.width), Math.round(y * file.height)];
  return [left, top, Math.round((x + width) * file.width) - left, Math.round((y + height) * file.height) - top];
}

export const same = (a, b) => a.every((value, i) => value === b[i]);
