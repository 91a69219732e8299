// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The elements over the picture, in the page and in <stereo-360>. Buttons of actions get their names and tooltips from
// the table of actions.js.
import { make } from './elements.js';
import { icon } from './icons.js';
import { t } from './translate.js';

const SPEEDS = [[0.25, '¼×'], [0.5, '½×'], [1, '1×'], [1.5, '1½×'], [2, '2×']];

const button = (action, more = {}) => make('button', { type: 'button', 'data-action': action, ...more }, icon(action));
const textButton = (action, text) => make('button', { type: 'button', 'data-action': action, textContent: t(text) });
const row = (id, label, field, more = {}) => make('label', { id: `${id}-row`, ...more }, `${t(label)} `, field);
const select = (id, options = []) => make('select', { id }, ...options.map(([value, text]) => make('option', { value, textContent: text, selected: value === 1 })));
const check = (id, label, more = {}) => make('label', { id: `${id}-row`, className: 'check', ...more }, make('input', { id, type: 'checkbox' }), ` ${t(label)}`);

function slider(id, label, [min, max, step], more = {}) {
  const range = make('input', { id, type: 'range', min, max, step });
  return row(id, label, make('span', { className: 'value' }, range, make('output')), more);
}

function bar() {
  const film = make('div', { id: 'film', hidden: true }, button('play'), button('step-back'), button('step'),
    make('input', { id: 'seek', type: 'range', min: 0, value: 0, ariaLabel: t('Frame'), 'data-tip': t('Seek') }),
    make('output', { id: 'time' }), button('sound'), button('subtitles', { hidden: true }));
  const mode = make('select', { id: 'mode', ariaLabel: t('Eyes'), 'data-tip': t('How both eyes share the screen'), 'data-key': 'M' });
  const tools = make('div', { id: 'tools' }, mode, button('swap'), button('compare', { hidden: true }), button('settings'),
    button('headset', { hidden: true }), button('system', { hidden: true }), button('fullscreen'), button('device', { hidden: true }), button('help'));
  return make('div', { id: 'bar', role: 'toolbar', ariaLabel: t('Viewer') }, film, tools);
}

function title() {
  const folder = make('span', { id: 'folder', hidden: true }, button('previous'), button('next'), button('list'));
  return make('div', { id: 'title' }, folder, make('span', { id: 'name' }), make('span', { id: 'count' }),
    make('output', { id: 'look', ariaLabel: t('Where you look'), hidden: true }));
}

function settings() {
  const why = make('details', { id: 'why', className: 'note' }, make('summary', { textContent: t('Why?') }), make('p', { id: 'reason' }));
  return make('form', { id: 'settings', popover: 'auto', ariaLabel: t('Settings') },
    row('layout', 'Layout', select('layout')), why,
    row('projection', 'Projection', select('projection')),
    slider('exposure', 'Exposure', [-8, 8, 0.25], { hidden: true }),
    row('tone', 'Tone', select('tone'), { hidden: true }),
    slider('fov', 'Field of view', [20, 150, 1]),
    slider('shift', 'Depth', [-3, 3, 0.1]),
    row('speed', 'Speed', select('speed', SPEEDS), { hidden: true }),
    check('loop', 'Loop', { hidden: true }), check('grid', 'Grid, every 10 degrees'), check('planet', 'Little planet'),
    check('turn', 'Turn slowly'), check('device', 'Look by turning this device', { hidden: true }),
    make('div', { className: 'row' }, textButton('recentre', 'Recentre'), textButton('screenshot', 'Screenshot'),
      textButton('link', 'Copy link'), textButton('comfort', 'What strains the eyes')));
}

function help() {
  const close = make('button', { ariaLabel: t('Close'), 'data-tip': t('Close'), 'data-key': 'Esc' }, icon('close'));
  return make('dialog', { id: 'help', 'aria-labelledby': 'help-title', tabIndex: -1 },
    make('form', { method: 'dialog' }, close), make('h1', { id: 'help-title', textContent: t('Help') }),
    make('p', { id: 'gestures' }), make('div', { id: 'keys' }));
}

// Returns the elements.
export function makeMarkup() {
  return [
    make('p', { id: 'message', role: 'alert', hidden: true }),
    make('div', { id: 'spinner', hidden: true }),
    make('progress', { id: 'loading', max: 1, ariaLabel: t('Loading'), hidden: true }),
    title(),
    make('span', { id: 'mark', hidden: true }),
    make('div', { id: 'foot' }, make('p', { id: 'toast', role: 'status' }), make('p', { id: 'hint', hidden: true }), bar()),
    settings(),
    help(),
  ];
}
