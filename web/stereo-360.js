// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// <stereo-360> puts a stereo panorama into any page, with this module and its neighbours on the page's own host:
//
//   <script type="module" src="stereo-360.js"></script>
//   <stereo-360 src="picture_360_TB.jpg" layout="top-bottom" projection="lat-long"></stereo-360>
//
// src         a picture or a video (.mp4 .m4v .mov .webm .mkv); or item="0", an item of view.json
// layout      top-bottom, side-by-side, mono, ...; projection: lat-long, vr180, eac, ... [what view.json says of the
//             file; else top-bottom, lat-long]
// mode        left, right, side-by-side, cross-eyed, anaglyph, wiggle, difference [left]
// yaw, pitch, fov   the first look, degrees [0, 0, 90]
// fps         of a video, for exact frames [30]
// view        the address of view.json, which has the tables of layouts and projections [beside this module]
// controls    "none" leaves the buttons out
// The element has the size that its page gives it. Its property `viewer` (viewer.js) is there from the event `ready` on.
import { Headset, hasHeadset } from './headset.js';
import { followPointer } from './look.js';
import { MODES, modeOf } from './modes.js';
import { loadShader } from './panorama.js';
import { Viewer } from './viewer.js';

const STYLE = `
:host { display: block; position: relative; aspect-ratio: 16 / 9; background: #1a1a1a; overflow: hidden; }
:host([hidden]) { display: none; }
canvas { position: absolute; inset: 0; width: 100%; height: 100%; cursor: grab; touch-action: pan-y; }
canvas:active { cursor: grabbing; }
div { position: absolute; right: 8px; bottom: 8px; display: flex; gap: 4px; }
button, select { font: 13px system-ui, sans-serif; color: #f1f1ef; background: rgb(22 23 25 / 72%);
  border: 1px solid rgb(255 255 255 / 14%); border-radius: 8px; min-height: 32px; padding: 0 10px; cursor: pointer; }
:focus-visible { outline: 2px solid #ffb648; outline-offset: -2px; }
p { position: absolute; inset: auto 12px 50%; margin: 0; text-align: center; color: #f1f1ef; font: 14px system-ui, sans-serif; }
[hidden] { display: none; }`;
const VIDEO = /\.(mp4|m4v|mov|webm|mkv)$/i;
const KEYS = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] };

function make(tag, attributes, text = '') {
  const element = Object.assign(document.createElement(tag), { textContent: text });
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

class Stereo360 extends HTMLElement {
  static observedAttributes = ['src', 'item', 'layout', 'projection', 'mode', 'yaw', 'pitch', 'fov'];

  connectedCallback() {
    if (!this.started) this.started = this.start().catch((error) => this.fail(error.message));
    else this.started.then(() => this.show());
  }

  // Frees the picture, which may be hundreds of megabytes.
  disconnectedCallback() {
    this.viewer?.loading?.abort();
    this.viewer?.close();
  }

  attributeChangedCallback(name) {
    if (!this.viewer) return;
    if (['src', 'item', 'layout', 'projection'].includes(name)) this.show();
    else this.viewer.set(this.look());
  }

  number(name, otherwise) {
    const value = this.getAttribute(name);
    return value !== null && value !== '' && Number.isFinite(Number(value)) ? Number(value) : otherwise;
  }

  look() {
    const mode = modeOf(this.getAttribute('mode')).name;
    return { yaw: this.number('yaw', 0), pitch: this.number('pitch', 0), fov: this.number('fov', 90), mode };
  }

  async start() {
    const root = this.attachShadow({ mode: 'open' });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLE);
    root.adoptedStyleSheets = [sheet];
    const name = this.getAttribute('aria-label') ?? 'Stereo panorama. Drag or use the arrow keys to look around.';
    this.canvas = make('canvas', { tabindex: 0, role: 'application', 'aria-label': name });
    this.bar = make('div', {});
    this.message = make('p', { role: 'alert', hidden: '' });
    root.append(this.canvas, this.message, this.bar);
    const table = new URL(this.getAttribute('view') ?? new URL('view.json', import.meta.url), document.baseURI);
    const answer = await fetch(table);
    if (!answer.ok) throw new Error(`${table.pathname} did not load (${answer.status}). Export it with ods view --export.`);
    const view = await answer.json();
    view.items.forEach((item) => ['image', 'left', 'right', 'light', 'preview', 'thumbnail'].forEach((file) => item[file] && (item[file] = new URL(item[file], table).href)));
    const viewer = new Viewer(this.canvas, view, await loadShader(), document.baseURI);
    followPointer(viewer);
    viewer.addEventListener('failed', ({ detail }) => this.fail(detail));
    viewer.addEventListener('open', () => (this.message.hidden = true));
    this.canvas.addEventListener('keydown', (event) => {
      const by = KEYS[event.key];
      if (!by) return;
      event.preventDefault();
      viewer.set({ yaw: viewer.state.yaw + by[0], pitch: viewer.state.pitch + by[1] });
    });
    viewer.set(this.look());
    this.viewer = viewer;
    if (this.getAttribute('controls') !== 'none') this.addControls();
    await this.show();
    this.dispatchEvent(new Event('ready'));
  }

  addControls() {
    const { viewer } = this;
    const modes = make('select', { 'aria-label': 'Eyes' });
    modes.append(...MODES.map(({ name, label }) => make('option', { value: name }, label)));
    modes.addEventListener('change', () => viewer.set({ mode: modes.value }));
    const play = make('button', { hidden: '' }, 'Play');
    play.addEventListener('click', () => viewer.picture?.toggle?.());
    const follow = () => {
      modes.value = viewer.state.mode;
      play.hidden = !viewer.picture?.video;
      play.textContent = viewer.picture?.video?.paused === false ? 'Pause' : 'Play';
    };
    for (const event of ['change', 'open']) viewer.addEventListener(event, follow);
    follow();
    const whole = make('button', {}, 'Full screen');
    whole.addEventListener('click', () => (document.fullscreenElement ? document.exitFullscreen() : this.requestFullscreen()));
    const headset = new Headset(viewer);
    const enter = make('button', { hidden: '' }, 'Headset');
    enter.addEventListener('click', () => headset.toggle().catch((error) => this.fail(error.message)));
    hasHeadset().then((has) => (enter.hidden = !has));
    this.bar.append(play, modes, enter, whole);
  }

  // The item that `item` or `src` names. view.json knows more of its own files than attributes do.
  find() {
    const { view } = this.viewer;
    const { items } = view;
    const src = this.getAttribute('src');
    if (!src) return this.number('item', 0);
    const image = new URL(src, document.baseURI).href;
    const known = items.findIndex((item) => item.image === image);
    if (known >= 0) return known;
    const name = decodeURIComponent(image.split('/').pop());
    const kind = VIDEO.test(new URL(image).pathname) ? 'video' : 'picture';
    items.push({ name, kind, image, layout: 'top-bottom', projection: 'lat-long', video: { fps: this.number('fps', 30) } });
    return items.length - 1;
  }

  async show() {
    const { view } = this.viewer;
    const choice = {};
    for (const [what, rows] of [['layout', view.layouts], ['projection', view.projections]]) {
      const name = this.getAttribute(what);
      if (name && !rows.some((row) => row.name === name)) {
        return this.fail(`There is no ${what} "${name}". There are: ${rows.map((row) => row.name).join(', ')}`);
      }
      if (name) choice[what] = name;
    }
    const item = this.find();
    if (!view.items[item]) return this.fail('There is no such picture. Set src, or item to an index of view.json.');
    await this.viewer.open(item, choice);
  }

  fail(words) {
    this.message.textContent = words;
    this.message.hidden = false;
  }
}

customElements.define('stereo-360', Stereo360);
