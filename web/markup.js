// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The elements over the picture, in the page and in <stereo-360>. Buttons of actions get their names and tooltips from
// the table of actions.js.
import { icon } from './icons.js';

const button = (action, more = '') => `<button type="button" data-action="${action}"${more}>${icon(action)}</button>`;
const slider = (id, label, range, more = '') =>
  `<label${more}>${label} <span class="value"><input id="${id}" type="range" ${range}><output></output></span></label>`;
const check = (id, label, more = '') => `<label class="check"${more}><input id="${id}" type="checkbox"> ${label}</label>`;
const speeds = [[0.25, '¼×'], [0.5, '½×'], [1, '1×'], [1.5, '1½×'], [2, '2×']]
  .map(([value, text]) => `<option value="${value}"${value === 1 ? ' selected' : ''}>${text}`).join('');

export const MARKUP = `
<p id="message" role="alert" hidden></p>
<div id="spinner" hidden></div>
<progress id="loading" max="1" aria-label="Loading" hidden></progress>
<div id="title"><span id="folder" hidden>${button('previous')}${button('next')}${button('list')}</span><span id="name"></span><span id="count"></span><output id="look" aria-label="Where you look" hidden></output></div>
<div id="foot"><p id="toast" role="status"></p><p id="hint" hidden></p><div id="bar" role="toolbar" aria-label="Viewer">
  <div id="film" hidden>
    ${button('play')}${button('step-back')}${button('step')}
    <input id="seek" type="range" min="0" value="0" aria-label="Frame" data-tip="Seek">
    <output id="time"></output>
    ${button('sound')}${button('subtitles', ' hidden')}
  </div>
  <div id="tools">
    <select id="mode" aria-label="Eyes" data-tip="How both eyes share the screen" data-key="M"></select>
    ${button('swap')}${button('compare', ' hidden')}${button('settings')}${button('headset', ' hidden')}${button('fullscreen')}${button('help')}
  </div>
</div></div>
<form id="settings" popover aria-label="Settings">
  <label>Layout <select id="layout"></select></label>
  <details id="why" class="note"><summary>Why?</summary><p id="reason"></p></details>
  <label>Projection <select id="projection"></select></label>
  ${slider('exposure', 'Exposure', 'min="-8" max="8" step="0.25"', ' id="exposure-row" hidden')}
  <label id="tone-row" hidden>Tone <select id="tone"></select></label>
  ${slider('fov', 'Field of view', 'min="20" max="150" step="1"')}
  ${slider('shift', 'Depth', 'min="-3" max="3" step="0.1"', ' id="shift-row"')}
  <label id="speed-row" hidden>Speed <select id="speed">${speeds}</select></label>
  ${check('loop', 'Loop', ' id="loop-row" hidden')}
  ${check('grid', 'Grid, every 10 degrees')}
  ${check('planet', 'Little planet')}
  ${check('turn', 'Turn slowly')}
  ${check('device', 'Look by turning this device', ' id="device-row" hidden')}
  <div class="row"><button type="button" data-action="recentre">Recentre</button><button type="button" data-action="screenshot">Screenshot</button><button type="button" data-action="link">Copy link</button>
    <button type="button" data-action="comfort">What strains the eyes</button></div>
</form>
<dialog id="help" aria-labelledby="help-title" tabindex="-1">
  <form method="dialog"><button aria-label="Close" data-tip="Close" data-key="Esc">${icon('close')}</button></form>
  <h1 id="help-title">Help</h1>
  <p id="gestures"></p>
  <div id="keys"></div>
</dialog>`;
