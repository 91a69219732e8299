// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The ways in which two eyes share a headset, or a flat screen: the parts of the screen (x, y, width, height as
// fractions, from the lower left) and the eye in each.
const WHOLE = [0, 0, 1, 1];
const LEFT_HALF = [0, 0, 0.5, 1];
const RIGHT_HALF = [0.5, 0, 0.5, 1];
const WIGGLE = 160; // milliseconds per eye
const CALM = 1200; // for those who want less motion
const wiggle = () => (matchMedia('(prefers-reduced-motion: reduce)').matches ? CALM : WIGGLE);

// visitors: the label for those who only look, in the modes that they need.
export const MODES = [
  { name: 'left', label: 'Left eye', visitors: 'Flat', parts: () => [{ at: WHOLE, eye: 0 }] },
  { name: 'right', label: 'Right eye', parts: () => [{ at: WHOLE, eye: 1 }] },
  {
    name: 'side-by-side',
    label: 'Side by side', visitors: '3D side by side',
    parts: () => [{ at: LEFT_HALF, eye: 0 }, { at: RIGHT_HALF, eye: 1 }],
  },
  {
    name: 'cross-eyed',
    label: 'Cross-eyed',
    parts: () => [{ at: LEFT_HALF, eye: 1 }, { at: RIGHT_HALF, eye: 0 }],
  },
  { name: 'anaglyph', label: 'Anaglyph', visitors: '3D red and cyan', parts: () => [{ at: WHOLE, show: 'anaglyph' }] },
  { name: 'wiggle', label: 'Wiggle', visitors: '3D wiggle', moves: true, parts: (now) => [{ at: WHOLE, eye: Math.floor(now / wiggle()) % 2 }] },
  { name: 'difference', label: 'Difference', parts: () => [{ at: WHOLE, show: 'difference' }] },
];

export const modeOf = (name) => MODES.find((mode) => mode.name === name) ?? MODES[0];

// The ways in which they share a headset: each eye has its own picture, or both have the same.
export const WORN = [{ name: 'stereo', label: 'Both eyes' }, { name: 'left', label: 'Left eye' }, { name: 'right', label: 'Right eye' }];
export const wornEye = ({ worn }, eye) => (worn === 'left' ? 0 : worn === 'right' ? 1 : eye);

// Converts a box to whole pixels of a canvas.
export function boxOf([x, y, width, height], canvas) {
  const [left, low] = [Math.round(x * canvas.width), Math.round(y * canvas.height)];
  return [left, low, Math.round((x + width) * canvas.width) - left, Math.round((y + height) * canvas.height) - low];
}
