// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// <stereo-360> puts a stereo panorama into any page, with the bar, the keys and the headset of the viewer's own page:
//
//   <script src="stereo-360.js"></script>
//   <stereo-360 src="picture_360_TB.jpg" layout="top-bottom" projection="lat-long"></stereo-360>
//
// The package's README lists attributes, properties, methods and events. An element out of view sleeps: it shows its
// last frame, and neither the GPU nor the picture's memory is used (contexts.js).
import { claim, release, settled } from './contexts.js';
import { make } from './elements.js';
import { forVisitors } from './faults.js';
import { LAYOUTS, PROJECTIONS } from './formats.js';
import { icon } from './icons.js';
import { modeOf } from './modes.js';
import { STYLE as PLAYER_STYLE } from './player-style.js';
import { Player } from './player.js';
import { FOV } from './viewer.js';
import { t, useLanguage } from './translate.js';

const STYLE = `${PLAYER_STYLE}
:host { display: block; position: relative; aspect-ratio: 16 / 9; background: #1a1a1a; overflow: hidden; }
:host([hidden]) { display: none; }
:host([filling]) { position: fixed !important; inset: 0 !important; z-index: 2147483647 !important; width: 100vw !important; height: 100dvh !important; max-width: none !important; max-height: none !important; margin: 0 !important; border-radius: 0 !important; aspect-ratio: auto !important; }
#player { position: absolute; inset: 0; }
#picture { touch-action: pan-y; }
:host(:is(:fullscreen, [filling])) #picture { touch-action: none; }
#poster { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: cover; pointer-events: none; }
#reveal { position: absolute; inset: 0; margin: auto; width: 76px; height: 76px; padding: 0; border-radius: 50%; background: var(--glass); border: 1px solid var(--edge); color: var(--text); }
#reveal svg { width: 40px; height: 40px; }
#again { display: block; margin: 10px auto 0; background: var(--touch); padding: 0 16px; }
.waiting :is(#bar, #title, #caption, #spots, #hint), .bare :is(#bar, #title) { display: none; }`;
const VIDEO = /\.(mp4|m4v|mov|webm|mkv|m3u8)$/i;
const FILES = ['image', 'system', 'fallback', 'left', 'right', 'light', 'preview', 'thumbnail', 'poster'];
const NEAR = '300px'; // distance from the window at which it loads
const FILE = ['src', 'item', 'layout', 'projection', 'fps'];
const LOOK = ['mode', 'yaw', 'pitch', 'fov'];
const calm = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

let sheet; // shared by all elements
const styleSheet = () => {
  if (!sheet) (sheet = new CSSStyleSheet()).replaceSync(STYLE);
  return sheet;
};

const Base = globalThis.HTMLElement ?? Object; // servers that make pages have no elements

export class Stereo360 extends Base {
  static observedAttributes = [...FILE, ...LOOK, 'poster', 'autorotate', 'controls'];
  static layouts = LAYOUTS.map(({ name }) => name);
  static projections = PROJECTIONS.map(({ name }) => name);

  connectedCallback() {
    if (!this.shadowRoot) this.build();
    this.isSeen = false;
    this.isNear = this.getAttribute('loading') === 'eager';
    if (this.isNear) this.approach();
    this.watcher = new IntersectionObserver((entries) => this.moved(entries.at(-1).isIntersecting), { rootMargin: NEAR });
    this.seeing = new IntersectionObserver((entries) => {
      this.isSeen = entries.at(-1).isIntersecting;
      if (this.isSeen) this.approach();
    });
    for (const watcher of [this.watcher, this.seeing]) watcher.observe(this);
  }

  disconnectedCallback() {
    for (const watcher of [this.watcher, this.seeing]) watcher.disconnect();
    this.isNear = this.wasNear = this.isSeen = false;
    this.player?.fill(false);
    release(this);
  }

  // is: whether it is in view, or nearly.
  moved(is) {
    if (is) this.isNear = this.wasNear = true;
    if (is) return this.approach();
    if (!this.wasNear || this.viewer?.session) return;
    this.isNear = false;
    release(this);
  }

  attributeChangedCallback(name) {
    if (!this.shadowRoot) return;
    if (name === 'poster') this.showPoster();
    if (name === 'controls') this.box.classList.toggle('bare', this.getAttribute('controls') === 'none');
    if (!this.player) return;
    if (name === 'autorotate') this.player.turn(this.turns());
    if (FILE.includes(name)) this.show();
    if (LOOK.includes(name)) this.viewer.set(this.look());
  }

  number(name, otherwise) {
    const value = this.getAttribute(name);
    return value !== null && value !== '' && Number.isFinite(Number(value)) ? Number(value) : otherwise;
  }

  look() {
    const mode = modeOf(this.getAttribute('mode')).name;
    return { yaw: this.number('yaw', 0), pitch: this.number('pitch', 0), fov: this.number('fov', FOV), mode };
  }

  turns() {
    return this.hasAttribute('autorotate') && !calm();
  }

  say(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  build() {
    const root = this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [styleSheet()];
    this.box = make('div', { id: 'player', className: 'waiting' }, make('div', { id: 'picture', tabIndex: 0, role: 'application' }), make('img', { id: 'poster', alt: '', hidden: true }));
    this.box.classList.toggle('bare', this.getAttribute('controls') === 'none');
    for (const event of ['pointerenter', 'pointerdown', 'focusin']) this.box.addEventListener(event, () => this.player && claim(this));
    root.append(this.box);
    this.showPoster();
  }

  // Shows the poster that the page specifies, else the exporter's own for an item.
  showPoster(item) {
    const poster = this.shadowRoot.getElementById('poster');
    const src = this.getAttribute('poster') ?? item?.poster;
    poster.hidden = !src || Boolean(this.wasShown);
    if (src) poster.src = src;
  }

  // Called when it is in view, or nearly: several calls are one.
  approach() {
    this.approaching ??= this.prepare().catch((error) => this.fail(error.message)).finally(() => (this.approaching = null));
  }

  async prepare() {
    await useLanguage();
    this.view ??= await this.loadView();
    if (!this.hasAttribute('src')) this.showPoster(this.view.items[this.number('item', 0)]);
    if (this.getAttribute('reveal') === 'click' && !this.isRevealed) await this.clicked();
    if (this.isNear) claim(this);
  }

  // Items with their addresses: from view.json, which ods view --export writes, or none.
  async loadView() {
    const path = this.getAttribute('tour');
    if (this.hasAttribute('src') && !this.hasAttribute('view')) return { items: [] };
    const table = new URL(path ?? this.getAttribute('view') ?? new URL('view.json', import.meta.url ?? document.baseURI), document.baseURI);
    const answer = await fetch(table);
    if (!answer.ok) throw new Error(`${table.pathname} did not load (${answer.status})${path ? '' : ': ods view --export writes it'}`);
    const view = await answer.json();
    if (path) return (await import('./tour.js')).readTour(view, table, (file) => this.itemOf(file));
    for (const item of view.items) FILES.forEach((file) => item[file] && (item[file] = new URL(item[file], table).href));
    return view;
  }

  // Waits until a visitor clicks.
  async clicked() {
    const button = make('button', { id: 'reveal', ariaLabel: t('Show the panorama') }, icon('play'));
    this.box.append(button);
    await new Promise((done) => button.addEventListener('click', done));
    button.remove();
    this.isRevealed = true;
  }

  // --- called by contexts.js ---

  isBusy() {
    return this.isLoading || Boolean(this.viewer?.session) || this.box.matches(':hover') || (this.playing && this.isNear);
  }

  wake(panorama) {
    this.isLoading = true;
    if (!this.player) this.start();
    this.viewer.wake(panorama);
  }

  sleep() {
    this.isLoading = false;
    this.player.turn(false);
    this.box.classList.add('waiting');
    return this.viewer.sleep();
  }

  // --- the panorama ---

  start() {
    const isSingle = () => this.hasAttribute('src') || this.hasAttribute('item');
    this.player = new Player(this.box, this.shadowRoot, { view: this.view, base: document.baseURI, nameOf: ({ title }) => title ?? this.ariaLabel ?? '', isSingle, isVisitors: this.getAttribute('controls') !== 'all' });
    const { viewer } = this;
    viewer.addEventListener('failed', ({ detail }) => this.fail(detail));
    viewer.addEventListener('loading', ({ detail }) => this.say('progress', detail));
    viewer.addEventListener('change', () => this.changed());
    viewer.addEventListener('open', () => this.opened());
    viewer.set(this.look());
    this.say('ready');
    this.show();
  }

  opened() {
    this.wasShown = this.shadowRoot.getElementById('poster').hidden = true;
    this.box.classList.remove('waiting');
    this.player.turn(this.turns());
    if (this.viewer.picture.isPreview) return;
    this.isLoading = false;
    this.say('load');
    settled();
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
    const { items } = this.view;
    const src = this.getAttribute('src');
    if (!src) return this.number('item', 0);
    const image = new URL(src, document.baseURI).href;
    const known = items.findIndex((item) => item.image === image);
    if (known >= 0) return known;
    return items.push(this.itemOf(image)) - 1;
  }

  itemOf(image) {
    const { pathname } = new URL(image);
    const kind = /\.glb$/i.test(pathname) ? 'layers' : VIDEO.test(pathname) ? 'video' : 'picture';
    return { name: decodeURIComponent(image.split('/').pop()), kind, image, system: this.hasAttribute('tagged') ? image : undefined, layout: 'top-bottom', projection: 'lat-long', video: { fps: this.number('fps', 30) } };
  }

  async show() {
    const choice = {};
    for (const [what, rows] of [['layout', LAYOUTS], ['projection', PROJECTIONS]]) {
      const name = this.getAttribute(what);
      if (name && !rows.some((row) => row.name === name)) {
        return this.fail(`There is no ${what} "${name}". There are: ${rows.map((row) => row.name).join(', ')}`);
      }
      if (name) choice[what] = name;
    }
    const item = this.findItem();
    if (!this.view.items[item]) return this.fail('There is no such picture. Set src, or item to an index of view.json.');
    this.showPoster(this.view.items[item]);
    await this.viewer.open(item, choice);
  }

  // Visitors see a hint; the page's author finds the reason in the console and in the event.
  fail(reason) {
    this.isLoading = false;
    let message = this.shadowRoot.getElementById('message');
    if (!message) this.box.append((message = make('p', { id: 'message', role: 'alert' })));
    message.textContent = forVisitors(reason);
    message.hidden = false;
    const again = make('button', { id: 'again', textContent: t('Try again') });
    again.addEventListener('click', () => this.startAgain());
    message.append(again);
    this.say('error', { message: reason });
    settled();
  }

  startAgain() {
    this.shadowRoot.getElementById('message').hidden = true;
    release(this);
    if (!this.player) this.view = undefined;
    this.approach();
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
for (const name of [...FILE, 'poster']) {
  Object.defineProperty(Stereo360.prototype, name, {
    get() { return this.getAttribute(name); },
    set(value) { value === null ? this.removeAttribute(name) : this.setAttribute(name, value); },
  });
}

if (globalThis.customElements && !customElements.get('stereo-360')) customElements.define('stereo-360', Stereo360);
