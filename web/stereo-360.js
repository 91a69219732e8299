// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// <stereo-360> puts a stereo panorama into any page, with the bar, the keys and the headset of the viewer's own page:
//
//   <script src="stereo-360.js"></script>
//   <stereo-360 src="picture_360_TB.jpg" layout="top-bottom" projection="lat-long"></stereo-360>
//
// ods view --export writes it as one classic script. docs/view.md lists attributes, properties, methods and events.
import { modeOf } from './modes.js';
import { loadShader } from './panorama.js';
import { Player } from './player.js';

const STYLE = `
:host { display: block; position: relative; aspect-ratio: 16 / 9; background: #1a1a1a; overflow: hidden; }
:host([hidden]) { display: none; }
#player { position: absolute; inset: 0; }
#picture { touch-action: pan-y; }
:host(:fullscreen) #picture { touch-action: none; }
#poster { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: cover; }
#reveal { position: absolute; inset: 0; margin: auto; width: 76px; height: 76px; padding: 0; border-radius: 50%; background: var(--glass); border: 1px solid var(--edge); color: var(--text); }
#reveal svg { width: 40px; height: 40px; }
#again { display: block; margin: 10px auto 0; background: var(--touch); padding: 0 16px; }
.waiting :is(#bar, #title), .bare :is(#bar, #title) { display: none; }`;
const VIDEO = /\.(mp4|m4v|mov|webm|mkv)$/i;
const NEAR = '300px'; // distance from the window at which it loads
const FILE = ['src', 'item', 'layout', 'projection', 'fps'];
const LOOK = ['mode', 'yaw', 'pitch', 'fov'];
const BASE = import.meta.url;
const calm = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

let parts; // the style and the shader, shared by all elements
const loadParts = () => (parts ??= Promise.all([fetch(new URL('player.css', BASE)).then((answer) => answer.text()), loadShader(BASE)]));

class Stereo360 extends HTMLElement {
  static observedAttributes = [...FILE, ...LOOK, 'poster', 'autorotate', 'controls'];

  connectedCallback() {
    if (!this.shadowRoot) this.build();
    if (this.player) return this.show();
    if (this.getAttribute('loading') === 'eager') return this.approach();
    this.watcher = new IntersectionObserver((entries) => entries.some((entry) => entry.isIntersecting) && this.approach(), { rootMargin: NEAR });
    this.watcher.observe(this);
  }

  // Frees the picture, which may be hundreds of megabytes.
  disconnectedCallback() {
    this.watcher?.disconnect();
    const viewer = this.player?.viewer;
    viewer?.loading?.abort();
    viewer?.close();
  }

  attributeChangedCallback(name) {
    if (!this.shadowRoot) return;
    if (name === 'poster') this.showPoster();
    if (name === 'controls') this.box.classList.toggle('bare', this.getAttribute('controls') === 'none');
    if (!this.player) return;
    if (name === 'autorotate') this.player.turn(this.turns());
    if (FILE.includes(name)) this.show();
    if (LOOK.includes(name)) this.player.viewer.set(this.look());
  }

  number(name, otherwise) {
    const value = this.getAttribute(name);
    return value !== null && value !== '' && Number.isFinite(Number(value)) ? Number(value) : otherwise;
  }

  look() {
    const mode = modeOf(this.getAttribute('mode')).name;
    return { yaw: this.number('yaw', 0), pitch: this.number('pitch', 0), fov: this.number('fov', 90), mode };
  }

  turns() {
    return this.hasAttribute('autorotate') && !calm();
  }

  say(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  build() {
    const root = this.attachShadow({ mode: 'open' });
    this.sheet = new CSSStyleSheet();
    this.sheet.replaceSync(STYLE);
    root.adoptedStyleSheets = [this.sheet];
    root.innerHTML = '<div id="player" class="waiting"><canvas id="picture" tabindex="0" role="application"></canvas><img id="poster" alt="" hidden></div>';
    this.box = root.getElementById('player');
    this.box.classList.toggle('bare', this.getAttribute('controls') === 'none');
    this.showPoster();
  }

  // Shows the poster that the page specifies, else the exporter's own for an item.
  showPoster(item) {
    const poster = this.shadowRoot.getElementById('poster');
    const src = this.getAttribute('poster') ?? item?.poster;
    poster.hidden = !src || this.loaded;
    if (src) poster.src = src;
  }

  // Called when it is in view, or nearly.
  approach() {
    this.watcher?.disconnect();
    if (this.started) return;
    this.started = this.start().catch((error) => this.fail(error.message));
  }

  async start() {
    const [style, shader] = await loadParts();
    this.sheet.replaceSync(style + STYLE);
    const root = this.shadowRoot;
    const table = new URL(this.getAttribute('view') ?? new URL('view.json', BASE), document.baseURI);
    const answer = await fetch(table);
    if (!answer.ok) throw new Error(`${table.pathname} did not load (${answer.status}): ods view --export writes it`);
    const view = await answer.json();
    view.items.forEach((item) => ['image', 'left', 'right', 'light', 'preview', 'thumbnail', 'poster'].forEach((file) => item[file] && (item[file] = new URL(item[file], table).href)));
    if (!this.hasAttribute('src')) this.showPoster(view.items[this.number('item', 0)]);
    if (this.getAttribute('reveal') === 'click') await this.clicked();
    const isSingle = () => this.hasAttribute('src') || this.hasAttribute('item');
    this.player = new Player(this.box, root, { view, shader, base: document.baseURI, nameOf: () => this.ariaLabel ?? '', isSingle });
    const { viewer } = this.player;
    this.box.append(root.getElementById('poster'));
    viewer.addEventListener('failed', ({ detail }) => this.fail(detail));
    viewer.addEventListener('loading', ({ detail }) => this.say('progress', detail));
    viewer.addEventListener('change', () => this.changed());
    viewer.addEventListener('open', () => this.opened());
    viewer.set(this.look());
    this.say('ready');
    await this.show();
  }

  // Waits until a visitor clicks.
  async clicked() {
    const button = Object.assign(document.createElement('button'), { id: 'reveal', ariaLabel: 'Show the panorama' });
    button.innerHTML = '<svg viewBox="0 0 24 24"><path d="M8 5.5v13l10.5-6.5z"/></svg>';
    this.box.append(button);
    await new Promise((done) => button.addEventListener('click', done));
    button.remove();
  }

  opened() {
    this.shadowRoot.getElementById('poster').hidden = true;
    this.box.classList.remove('waiting');
    if (!this.viewer.picture.isPreview) this.say('load');
    this.player.turn(this.turns());
  }

  changed() {
    const { yaw, pitch, fov, mode } = this;
    const look = { yaw, pitch, fov, mode };
    if (Object.keys(look).some((name) => look[name] !== this.said?.[name])) this.say('look', look);
    this.said = look;
    const { playing } = this;
    if (playing !== Boolean(this.played)) this.say(playing ? 'play' : 'pause');
    this.played = playing;
  }

  // The item that `item` or `src` specifies. view.json has more data of its own files than attributes do.
  findItem() {
    const { items } = this.player.viewer.view;
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
    const { viewer } = this.player;
    const { view } = viewer;
    const choice = {};
    for (const [what, rows] of [['layout', view.layouts], ['projection', view.projections]]) {
      const name = this.getAttribute(what);
      if (name && !rows.some((row) => row.name === name)) {
        return this.fail(`There is no ${what} "${name}". There are: ${rows.map((row) => row.name).join(', ')}`);
      }
      if (name) choice[what] = name;
    }
    const item = this.findItem();
    if (!view.items[item]) return this.fail('There is no such picture. Set src, or item to an index of view.json.');
    this.showPoster(view.items[item]);
    await viewer.open(item, choice);
  }

  // Visitors see a hint; the page's author finds the reason in the console and in the event.
  fail(reason) {
    console.warn(`stereo-360: ${reason}`);
    let message = this.shadowRoot.getElementById('message');
    if (!message) this.box.append((message = Object.assign(document.createElement('p'), { id: 'message', role: 'alert' })));
    const words = /WebGL/.test(reason) ? 'Your browser cannot show this panorama. A newer one can.'
      : /did not load|broke/.test(reason) ? 'This panorama did not load. Check your connection.' : 'This panorama cannot be shown.';
    message.textContent = words;
    message.hidden = false;
    const again = Object.assign(document.createElement('button'), { id: 'again', textContent: 'Try again' });
    again.addEventListener('click', () => {
      message.hidden = true;
      if (this.player) return this.show();
      parts = this.started = undefined;
      this.approach();
    });
    message.append(again);
    this.say('error', { message: reason });
  }

  // --- for scripts ---

  get viewer() {
    return this.player?.viewer;
  }

  get loaded() {
    return Boolean(this.viewer?.picture);
  }

  get playing() {
    const video = this.viewer?.picture?.video;
    return Boolean(video && !video.paused);
  }

  get currentTime() {
    return this.viewer?.picture?.video?.currentTime ?? 0;
  }

  set currentTime(seconds) {
    this.viewer?.picture?.seek?.(seconds);
  }

  async play() {
    await this.viewer?.picture?.video?.play();
  }

  pause() {
    this.viewer?.picture?.video?.pause();
  }

  // { yaw, pitch, fov, mode }, each of them optional.
  lookAt(look) {
    this.viewer?.set(look);
  }

  // A PNG as a Blob.
  screenshot() {
    return this.viewer?.screenshot();
  }

  // Only after a click or a key, as browsers require.
  enterHeadset() {
    return this.player?.enterHeadset();
  }
}

// The look consists of properties that follow it; the others reflect their attributes.
for (const name of LOOK) {
  Object.defineProperty(Stereo360.prototype, name, {
    get() { return this.viewer?.state[name] ?? this.look()[name]; },
    set(value) { this.setAttribute(name, value); },
  });
}
for (const name of ['src', 'item', 'layout', 'projection', 'fps', 'poster']) {
  Object.defineProperty(Stereo360.prototype, name, {
    get() { return this.getAttribute(name); },
    set(value) { value === null ? this.removeAttribute(name) : this.setAttribute(name, value); },
  });
}

customElements.define('stereo-360', Stereo360);
