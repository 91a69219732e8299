// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The icons, in one style: 24 units wide, lines of 1.6 with round ends. Two shapes in one icon are the states of a
// switch.
const line = (d, more = '') => [d, `line${more}`];
const shape = (d, more = '') => [d, more.trim()];
const ON = ' when-on';
const OFF = ' when-off';

const ICONS = {
  play: [shape('M8 5.5v13l10.5-6.5z', OFF), shape('M8 5.5h3v13H8zM14 5.5h3v13h-3z', ON)],
  'step-back': [shape('M17.5 6v12L9 12zM6.5 6h2v12h-2z')],
  step: [shape('M6.5 6v12l8.5-6zM15.5 6h2v12h-2z')],
  sound: [shape('M4 9.5v5h3.5L12 18.5v-13L7.5 9.5z'), line('M15 9a4 4 0 0 1 0 6M17.5 6.5a8 8 0 0 1 0 11', ON), line('m15.5 9.5 5 5m0-5-5 5', OFF)],
  subtitles: [line('M3.5 7a2 2 0 0 1 2-2h13a2 2 0 0 1 2 2v10a2 2 0 0 1-2 2h-13a2 2 0 0 1-2-2zM7 12h4m2.5 0h3.5M7 15.5h7m2.5 0h.5')],
  previous: [line('m14.5 6-6 6 6 6')],
  next: [line('m9.5 6 6 6-6 6')],
  list: [line('M5 5h5.5v5.5H5zM13.5 5H19v5.5h-5.5zM5 13.5h5.5V19H5zM13.5 13.5H19V19h-5.5z')],
  down: [line('m6 9.5 6 6 6-6')],
  swap: [line('M4 8.5h15m-3.5-3.5 3.5 3.5-3.5 3.5M20 15.5H5m3.5-3.5L5 15.5 8.5 19')],
  settings: [line('M4 8h8m5 0h3M4 16h3m5 0h8M17 8a2.5 2.5 0 1 1-5 0 2.5 2.5 0 1 1 5 0M12 16a2.5 2.5 0 1 1-5 0 2.5 2.5 0 1 1 5 0')],
  headset: [line('M3.5 8.5a2 2 0 0 1 2-2h13a2 2 0 0 1 2 2v6a2 2 0 0 1-2 2h-3l-2-2.5h-3l-2 2.5h-3a2 2 0 0 1-2-2z')],
  system: [line('M3.5 6.5a1.5 1.5 0 0 1 1.5-1.5h14a1.5 1.5 0 0 1 1.5 1.5v9a1.5 1.5 0 0 1-1.5 1.5H5a1.5 1.5 0 0 1-1.5-1.5zM8 20h8'), shape('M10 8v6l5-3z')],
  device: [line('M8.5 4h7a1.5 1.5 0 0 1 1.5 1.5v13a1.5 1.5 0 0 1-1.5 1.5h-7A1.5 1.5 0 0 1 7 18.5v-13A1.5 1.5 0 0 1 8.5 4zM3.5 9a8 8 0 0 0 0 6M20.5 9a8 8 0 0 1 0 6')],
  fullscreen: [line('M4.5 9V4.5H9M15 4.5h4.5V9M19.5 15v4.5H15M9 19.5H4.5V15')],
  help: [line('M9 9.5a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.1-1.5 2.4'), shape('M12 16.4a1.1 1.1 0 1 1 0 2.2 1.1 1.1 0 0 1 0-2.2z')],
  close: [line('m7 7 10 10m0-10L7 17')],
  compare: [line('M12 3.5v17M5.5 6.5H9m-3.5 0a1.5 1.5 0 0 0-1.5 1.5v8a1.5 1.5 0 0 0 1.5 1.5H9M15 6.5h3.5A1.5 1.5 0 0 1 20 8v8a1.5 1.5 0 0 1-1.5 1.5H15')],
  undo: [line('M8.5 5.5 5 9l3.5 3.5M5.5 9H14a4.75 4.75 0 0 1 0 9.5H9')],
  redo: [line('m15.5 5.5 3.5 3.5-3.5 3.5M18.5 9H10a4.75 4.75 0 0 0 0 9.5h5')],
  reset: [line('M6 12a6 6 0 1 0 2-4.47M8 4v4h4')],
};

// An icon as an element: pages may forbid text that becomes HTML (Trusted Types).
export function icon(name) {
  const create = (tag, attributes) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  };
  const svg = create('svg', { viewBox: '0 0 24 24', 'aria-hidden': 'true' });
  svg.append(...ICONS[name].map(([d, className]) => create('path', { d, class: className })));
  return svg;
}
