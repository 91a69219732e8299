// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A viewer with all elements over its picture: bar, settings, help, keys. The page and <stereo-360> each have one.
import { ACTIONS, actionOf, applies } from './actions.js';
import { Controls } from './controls.js';
import { make } from './elements.js';
import { forVisitors } from './faults.js';
import { clamp } from './geometry.js';
import { itemName } from './item-name.js';
import { followPointer } from './look.js';
import { makeMarkup } from './markup.js';
import { watchTips } from './tips.js';
import { Viewer } from './viewer.js';
import { keep, recall } from './storage.js';
import { t } from './translate.js';

const IDLE = 3000; // milliseconds until the bar fades
const TURN = 6; // degrees per second
const EXTRAS = {
  grid: () => import('./grid-numbers.js'),
  tour: () => import('./tour.js'),
  subtitles: () => import('./subtitles.js'),
  sound: () => import('./ambisonics.js'),
};

const GREETED = 'omnistereo-greeted';
let greeted = false; // where the browser stores nothing

const wasGreeted = () => greeted || Boolean(recall(GREETED));

const hasHeadset = async () => Boolean(await navigator.xr?.isSessionSupported('immersive-vr').catch(() => false));

export class Player {
  // element: contains #picture, for the viewer, and receives the rest. root: its document or shadow root. keys: the element
  // that receives keys. isPage: the page has no other content, so the wheel belongs to the picture, too. nameOf(item):
  // its name for users, if any; isSingle(): whether there are no other items to choose. isVisitors: the bar has what
  // visitors need, not the tools of the makers of pictures.
  constructor(element, root, { view, base, wanted = {}, keys = element, isPage = false, isVisitors = false, nameOf = itemName, isSingle = () => false }) {
    Object.assign(this, { element, root, wanted, isPage, isVisitors, keys, nameOf, isSingle });
    element.append(...makeMarkup());
    const viewer = new Viewer(this.find('picture'), view, base);
    this.viewer = viewer;
    this.controls = new Controls(this);
    followPointer(viewer, viewer.element, () => isPage || root.activeElement === viewer.element || this.isFullscreen());
    viewer.addEventListener('open', () => this.fail(''));
    viewer.addEventListener('failed', ({ detail }) => this.fail(isVisitors && isPage ? forVisitors(detail) : detail));
    this.watchKeys();
    this.watchIdle();
    this.watchExtras();
    this.greet();
    watchTips(root);
    hasHeadset().then((has) => {
      root.querySelector('#tools [data-action="headset"]').hidden = !has;
      if (!has) return;
      this.loadHeadset().catch(() => {}); // prepares for entering by a click without waiting
      this.showBothEyes().catch(() => {});
    });
  }

  find(id) {
    return this.root.getElementById(id);
  }

  toast(words) {
    if (typeof words !== 'string') return;
    const toast = this.find('toast');
    toast.textContent = words;
    toast.classList.toggle('shown', words !== '');
    clearTimeout(this.toasting);
    this.toasting = setTimeout(() => toast.classList.remove('shown'), 1500 + 30 * words.length);
  }

  fail(words) {
    const message = this.find('message');
    message.textContent = words;
    message.hidden = !words;
  }

  act(id, event) {
    this.run(ACTIONS.find((action) => action.id === id), event);
  }

  run(action, event) {
    if (!applies(action, this)) return;
    const said = (event?.shiftKey && action.fine ? action.fine : action.run)(this, this.viewer);
    Promise.resolve(said).then((words) => this.toast(words), (error) => this.toast(error.message));
  }

  async loadHeadset() {
    const { Headset } = await import('./headset.js');
    return (this.headset ??= new Headset(this.viewer, { layers: this.wanted.layers }));
  }

  // In a headset's browser, both eyes without entering, where it can do so.
  async showBothEyes() {
    const { InlineStereo } = await import('./inline-stereo.js');
    const flat = this.find('mode').options[0];
    const { textContent } = flat;
    this.stereo = new InlineStereo(this.viewer, (is) => (flat.textContent = is ? '3D' : textContent));
  }

  async enterHeadset() {
    if (this.viewer.state.planet) this.act('planet'); // planet is for flat screens
    try {
      await (await this.loadHeadset()).toggle();
    } catch (error) {
      this.toast(error.name === 'NotSupportedError' || !navigator.xr ? t('No headset is connected') : t('The headset says: {}', error.message));
    }
  }

  async screenshot() {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(await this.viewer.screenshot());
    const { yaw, pitch } = this.viewer.state;
    link.download = `${this.viewer.about.name.replace(/\.\w+$/, '')} ${Math.round(yaw)} ${Math.round(pitch)}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    return t('Screenshot saved');
  }

  isFullscreen() {
    return Boolean(document.fullscreenElement || this.isFilling);
  }

  // 'screen'; 'window', where there is no API for it (iPhones); or nothing, in a frame that may not.
  fullscreenWay() {
    if (document.fullscreenEnabled) return 'screen';
    return this.isPage || window.top !== window ? '' : 'window';
  }

  async toggleFullscreen() {
    if (document.fullscreenElement) return document.exitFullscreen();
    const way = this.fullscreenWay();
    if (way === 'window') return this.fill(!this.isFilling);
    const element = this.isPage ? document.documentElement : this.root.host;
    if (way) return element.requestFullscreen().catch(() => t('The browser refuses full screen'));
  }

  // Fills the window with the element, or not any more.
  fill(is) {
    if (is === Boolean(this.isFilling)) return;
    this.isFilling = is;
    this.root.host.toggleAttribute('filling', is);
    document.documentElement.style.overflow = is ? 'hidden' : '';
  }

  async toggleList() {
    this.list ??= import('./list.js').then(({ makeList }) => makeList(this));
    (await this.list)();
  }

  toggleSettings() {
    this.find('settings').togglePopover();
  }

  async help() {
    const { showHelp } = await import('./help.js');
    if (!this.find('help').open) showHelp(this);
  }

  // Turns slowly to the right, until the user grabs the picture.
  turn(is = !this.turning) {
    if (is === Boolean(this.turning)) return;
    this.turning = is ? performance.now() : 0;
    const step = (now) => {
      if (!this.turning) return;
      const { viewer } = this;
      if (!viewer.session) viewer.set({ yaw: viewer.state.yaw + (TURN * clamp(now - this.turning, 0, 100)) / 1000 });
      this.turning = Math.max(now, 1);
      requestAnimationFrame(step);
    };
    if (is) requestAnimationFrame(step);
    else this.viewer.say('change');
  }

  watchKeys() {
    this.keys.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || this.find('help').open) return;
      const { key } = event;
      if (key === 'Escape') this.fill(false);
      const target = event.composedPath()[0];
      const takesKeys = target.matches?.('select, textarea, [contenteditable], input:not([type="checkbox"])');
      const isText = key.length === 1 && key !== ' ';
      if (takesKeys && (!target.matches('input[type="range"]') || !isText)) return;
      if ((key === ' ' || key === 'Enter') && target.matches?.('button, input, summary, a')) return;
      const action = actionOf(isText ? key.toLowerCase() : key, this);
      if (!action) return;
      event.preventDefault();
      if (/^Arrow|^Home/.test(key) || action.id === 'recentre') this.turn(false);
      this.run(action, event);
    });
    this.viewer.element.addEventListener('pointerdown', () => this.turn(false));
  }

  // Invites to drag, until the first touch; those who have visited before know it.
  greet() {
    const { element, viewer } = this;
    const hint = this.find('hint');
    const touches = matchMedia('(pointer: coarse)').matches;
    const text = touches ? 'Drag to look around, pinch to zoom' : this.isPage ? 'Drag to look around, wheel to zoom, ? for all keys' : 'Drag to look around';
    hint.append(make('span', { className: 'hand', ariaHidden: 'true', textContent: '☝' }), ` ${t(text)}`);
    const show = () => (hint.hidden = wasGreeted());
    const end = () => {
      viewer.removeEventListener('open', show);
      this.isTouched = hint.hidden = true;
      greeted = true;
      keep(GREETED, '1');
    };
    viewer.addEventListener('open', show);
    const heard = this.isPage ? document : element;
    for (const event of ['pointerdown', 'wheel', 'keydown']) heard.addEventListener(event, end, { once: true, passive: true });
  }

  // The bar fades without movement after the first touch, unless a part of it is in use or a drag is held still.
  watchIdle() {
    const { element } = this;
    let timer;
    const wake = () => {
      element.classList.remove('idle');
      clearTimeout(timer);
      timer = setTimeout(() => {
        if (element.querySelector(':popover-open, dialog[open], #picture:active')) return wake();
        if (!this.isTouched) return;
        if (!element.querySelector('#bar, #title').matches(':hover, :has(:focus-visible)')) element.classList.add('idle');
      }, IDLE);
    };
    const heard = this.isPage ? window : element;
    for (const event of ['pointermove', 'pointerdown', 'keydown', 'focusin', 'wheel']) heard.addEventListener(event, wake, { passive: true });
    wake();
  }

  // Features that most visitors do not need are loaded on first use.
  watchExtras() {
    const { viewer } = this;
    const extra = (name, is, begin) => {
      let loaded = false;
      const look = () => {
        if (loaded || !is(viewer)) return;
        loaded = true;
        EXTRAS[name]().then(begin).catch((error) => this.toast(error.message));
      };
      for (const event of ['change', 'open']) viewer.addEventListener(event, look);
    };
    extra('grid', ({ state }) => state.grid, ({ numberGrid }) => numberGrid(viewer));
    extra('tour', ({ about, view }) => about?.hotspots || about?.caption || view.tour, ({ showTour }) => showTour(this));
    extra('subtitles', ({ about }) => about?.video?.subtitles, ({ showSubtitles }) => showSubtitles(this));
    extra('sound', ({ about }) => about?.video?.sound, ({ hearVideos }) => hearVideos(this));
  }

  // --- two pictures at once (compare.js) ---

  // pin: the picture to put beside; null for the present one.
  async compare(pin) {
    if (this.viewer.compare) return this.endCompare();
    const { startCompare } = await import('./compare.js');
    await startCompare(this, pin);
    this.viewer.say('change');
    return pin ? '' : t('This stays on the right: now choose another picture, or other settings');
  }

  endCompare() {
    this.viewer.compare?.end();
    return t('One picture');
  }

  async comfort() {
    if (this.viewer.compare) return this.endCompare();
    const { showComfort } = await import('./compare.js');
    this.toast(t('Judging …'));
    return showComfort(this);
  }
}
