// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Films as layers that the browser fills by itself, frame by frame (WebXR Layers, XRMediaBinding): the page copies and
// draws nothing. Only formats that such a layer shows truly: a lat-long whose texels are directions, one eye or two
// halves in the browser's order, left eye on top or on the left. The shader draws all others.
import { same } from './form.js';
import { wornEye } from './modes.js';

const LAT_LONG = 0; // numbers of the kernel's projections,
const PARALLEL = 0; // and of its convergences
const WHOLE = [0, 0, 1, 1];
const LAYOUTS = {
  mono: [...WHOLE, ...WHOLE],
  'stereo-top-bottom': [0, 0, 1, 0.5, 0, 0.5, 1, 0.5],
  'stereo-left-right': [0, 0, 0.5, 1, 0.5, 0, 0.5, 1],
};

export function hasMediaLayers() {
  return typeof XRMediaBinding !== 'undefined' && typeof XRMediaBinding.prototype.createEquirectLayer === 'function';
}

// Returns the layer of a picture (picture.js) as XRMediaEquirectLayerInit, without its space, and its heading,
// radians to the right; null if the shader must draw.
export function filmLayer({ video, camera, layout, beside }, state) {
  if (!video || beside || state.swap || state.grid || [0, 1].some((eye) => wornEye(state, eye) !== eye)) return null;
  const { projection: { kind, center, span }, convergence } = camera;
  if (kind !== LAT_LONG || convergence !== PARALLEL) return null;
  const name = Object.keys(LAYOUTS).find((each) => same(LAYOUTS[each], [...layout.left, ...layout.right]));
  if (!name) return null;
  const [upper, lower] = [1, -1].map((side) => center[1] + (side * span[1]) / 2);
  return {
    heading: center[0],
    init: { layout: name, radius: 0, centralHorizontalAngle: span[0], upperVerticalAngle: upper, lowerVerticalAngle: lower },
  };
}
