// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers of the grid of degrees: yaw along the horizon, pitch along the meridian closest to the middle of the
// view. Loaded when the grid is first shown.
import { partsOf, placeOf } from './places.js';

const WIDE = 100; // degrees: from this field of view on, every third line has a number

const from = (low, high, step) => Array.from({ length: (high - low) / step + 1 }, (_, i) => low + i * step);
const signed = (angle) => `${angle > 0 ? '+' : ''}${angle}°`.replace('-', '−');

// The numbered lines: their directions and labels.
function lines({ yaw, fov }) {
  const every = fov < WIDE ? 10 : 30;
  const meridian = every * Math.round(yaw / every);
  const headings = from(every - 180, 180, every).map((angle) => ({ yaw: angle, pitch: 0, words: signed(angle) }));
  const heights = from(every - 90, 90 - every, every).map((angle) => ({ yaw: meridian, pitch: angle, words: signed(angle) }));
  return [...headings, ...heights.filter(({ pitch }) => pitch)];
}

export function numberGrid(viewer) {
  const layer = document.createElement('div');
  layer.id = 'numbers';
  layer.ariaHidden = true; // the bar shows the direction of the view
  viewer.element.after(layer);
  const place = () => {
    layer.hidden = !viewer.state.grid || Boolean(viewer.session);
    if (layer.hidden) return;
    const shown = partsOf(viewer).flatMap((part) => lines(viewer.state).map((line) => ({ ...line, at: placeOf(viewer, line, part) })));
    layer.replaceChildren(...shown.filter(({ at }) => at).map(({ at, words }) => {
      const number = document.createElement('span');
      number.textContent = words;
      number.style.translate = `${at[0] + 4}px ${at[1] + 2}px`;
      return number;
    }));
  };
  for (const event of ['change', 'open']) viewer.addEventListener(event, place);
  new ResizeObserver(place).observe(viewer.element);
}
