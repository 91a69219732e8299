// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A viewer with all elements over its picture: bar, settings, help, keys. The page and <stereo-360> each have one.
import { ACTIONS, actionOf, applies } from './actions.js';
import { Controls } from './controls.js';
import { clamp } from './geometry.js';
import { followPointer } from './look.js';
import { MARKUP } from './markup.js';
import { watchTips } from './tips.js';
import { Viewer } from './viewer.js';

const IDLE = 3000; // milliseconds until the bar fades
const TURN = 6; // degrees per second
const EXTRAS = {
  grid: () => import('./grid-numbers.js'),
  notes: () => import('./notes.js'),
  subtitles: () => import('./subtitles.js'),
  sound: () => import('./ambisonics.js'),
};

const hasHeadset = async () => Boolean(await navigator.xr?.isSessionSupported('immersive-vr').catch(() => false));

export class Player {
  // element: contains the canvas #picture and receives the rest. root: its document or shadow root. keys: the element
  // that receives keys. isPage: the page has no other content, so the wheel belongs to the picture, too. nameOf(item):
  // its name for users, if any; isSingle(): whether there are no other items to choose.
  constructor(element, root, { view, shader, base, wanted = {}, keys = element, isPage = false, nameOf = ({ name }) => name, isSingle = () => false }) {
    Object.assign(this, { element, root, wanted, isPage, keys, nameOf, isSingle });
    element.insertAdjacentHTML('beforeend', MARKUP);
    const viewer = new Viewer(this.find('picture'), view, shader, base);
    this.viewer = viewer;
    this.controls = new Controls(this);
    followPointer(viewer, viewer.canvas, () => isPage || root.activeElement === viewer.canvas || this.isFullscreen());
    viewer.addEventListener('open', () => this.fail(''));
    viewer.addEventListener('failed', ({ detail }) => this.fail(detail));
    this.watchKeys();
    this.watchIdle();
    this.watchExtras();
    watchTips(root);
    hasHeadset().then((has) => {
      root.querySelector('#tools [data-action="headset"]').hidden = !has;
      if (has) this.loadHeadset().catch(() => {}); // prepares for entering by a click without waiting
    });
  }

  find(id) {
    return this.root.getElementById(id);
  }

  // The initial field of view.
  fov() {
    return this.element.clientWidth < this.element.clientHeight ? 60 : 90;
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

  async enterHeadset() {
    if (this.viewer.state.planet) this.act('planet'); // planet is for flat screens
    try {
      await (await this.loadHeadset()).toggle();
    } catch (error) {
      this.toast(error.name === 'NotSupportedError' || !navigator.xr ? 'No headset is connected' : `The headset says: ${error.message}`);
    }
  }

  async screenshot() {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(await this.viewer.screenshot());
    const { yaw, pitch } = this.viewer.state;
    link.download = `${this.viewer.about.name.replace(/\.\w+$/, '')} ${Math.round(yaw)} ${Math.round(pitch)}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    return 'Screenshot saved';
  }

  isFullscreen() {
    return Boolean(document.fullscreenElement);
  }

  toggleFullscreen() {
    if (this.isFullscreen()) document.exitFullscreen();
    else (this.isPage ? document.documentElement : this.root.host).requestFullscreen?.().catch(() => {});
  }

  async toggleList() {
    this.list ??= import('./list.js').then(({ makeList }) => makeList(this));
    (await this.list)();
  }

  toggleSettings() {
    this.find('settings').togglePopover();
  }

  help() {
    this.controls.fillHelp();
    this.find('help').showModal();
    this.find('help').focus(); // not its button, whose tooltip would appear
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
    this.viewer.canvas.addEventListener('pointerdown', () => this.turn(false));
  }

  // The bar fades without movement, unless a part of it is in use or a drag is held still.
  watchIdle() {
    const { element } = this;
    let timer;
    const wake = () => {
      element.classList.remove('idle');
      clearTimeout(timer);
      timer = setTimeout(() => {
        if (element.querySelector(':popover-open, dialog[open], canvas:active')) return wake();
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
    extra('notes', ({ about }) => about?.hotspots || about?.caption, ({ showNotes }) => showNotes(viewer));
    extra('subtitles', ({ about }) => about?.video?.subtitles, ({ showSubtitles }) => (this.subtitles = showSubtitles(this)));
    extra('sound', ({ about }) => about?.video?.sound, ({ hearVideos }) => hearVideos(this));
  }

  // --- two pictures at once (compare.js) ---

  // pin: the picture to put beside; null for the present one.
  async compare(pin) {
    if (this.viewer.compare) return this.endCompare();
    const { startCompare } = await import('./compare.js');
    await startCompare(this, pin);
    this.viewer.say('change');
    return pin ? '' : 'This stays on the right: now choose another picture, or other settings';
  }

  endCompare() {
    this.viewer.compare?.end();
    return 'One picture';
  }

  async comfort() {
    if (this.viewer.compare) return this.endCompare();
    const { showComfort } = await import('./compare.js');
    this.toast('Judging …');
    return showComfort(this);
  }
}
