// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Starts the page: reads view.json, makes the viewer, wires the controls to it.
import { ACTIONS } from './actions.js';
import { Controls } from './controls.js';
import { Headset, hasHeadset } from './headset.js';
import { followPointer } from './look.js';
import { loadShader } from './panorama.js';
import { readState, writeState } from './state.js';
import { Viewer } from './viewer.js';

const find = (id) => document.getElementById(id);
const IDLE = 3000; // milliseconds until the bar fades
const isNarrow = () => innerWidth < innerHeight;

class Page {
  constructor(viewer, wanted) {
    Object.assign(this, { viewer, wanted, frame: wanted.frame });
    this.headset = new Headset(viewer, { layers: wanted.layers });
    this.controls = new Controls(this);
  }

  fov() {
    return isNarrow() ? 60 : 90;
  }

  toast(words) {
    if (typeof words !== 'string') return;
    find('toast').textContent = words;
    find('toast').classList.add('shown');
    clearTimeout(this.toasting);
    this.toasting = setTimeout(() => find('toast').classList.remove('shown'), 1500);
  }

  fail(words) {
    find('message').textContent = words;
    find('message').hidden = !words;
  }

  act(id, event) {
    const action = ACTIONS.find((each) => each.id === id);
    if (action.when && !action.when(this.viewer)) return;
    this.toast((event?.shiftKey && action.fine ? action.fine : action.run)(this, this.viewer));
  }

  async enterHeadset() {
    try {
      await this.headset.toggle();
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
    this.toast('Screenshot saved');
  }

  toggleSettings() {
    find('settings').togglePopover();
  }

  help() {
    this.controls.fillHelp();
    find('help').showModal();
  }
}

function watchKeys(page) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || find('help').open) return;
    const { target, key } = event;
    const takesKeys = target.matches?.('select, input[type="range"]');
    const isText = key.length === 1 && key !== ' ';
    if (takesKeys && (target.matches('select') || !isText)) return;
    if (key === ' ' && target.matches?.('button, input')) return;
    const wanted = isText ? key.toLowerCase() : key;
    const action = ACTIONS.find(({ keys }) => keys.includes(wanted));
    if (!action) return;
    event.preventDefault();
    page.act(action.id, event);
  });
}

// The bar fades while nobody moves, unless something of it is in use or a drag is held still.
function watchIdle() {
  let timer;
  const wake = () => {
    document.body.classList.remove('idle');
    clearTimeout(timer);
    timer = setTimeout(() => {
      if (find('settings').matches(':popover-open') || find('help').open || find('picture').matches(':active')) return wake();
      if (!find('bar').matches(':hover, :has(:focus-visible)')) document.body.classList.add('idle');
    }, IDLE);
  };
  for (const event of ['pointermove', 'pointerdown', 'keydown', 'focusin', 'wheel']) addEventListener(event, wake, { passive: true });
  wake();
}

function watchGrid(viewer) {
  let loading;
  const load = () => {
    if (viewer.state.grid) loading ??= import('./grid-numbers.js').then(({ numberGrid }) => numberGrid(viewer));
  };
  viewer.addEventListener('change', load);
  load();
}

// Keeps the address up to date, and follows it where somebody changes it.
function watchAddress(page) {
  const { viewer } = page;
  let written = location.hash;
  let timer;
  const write = () => {
    timer = undefined;
    const { picture, item, state, choice } = viewer;
    written = writeState({ item, frame: picture?.video?.paused ? picture.frame() : 0, layers: page.wanted.layers, look: state, choice });
    history.replaceState(null, '', written);
  };
  for (const event of ['change', 'open']) viewer.addEventListener(event, () => (timer ??= setTimeout(write, 250)));
  addEventListener('hashchange', () => {
    if (location.hash === written) return;
    const to = readState(location.hash);
    viewer.set(to.look);
    page.frame = to.frame;
    if (!viewer.scene) viewer.open(Math.min(to.item, viewer.view.items.length - 1), to.choice);
  });
}

// Says when the server has ended, and goes on when the next one is there, which has the same address; the studio does so
// itself. Begins to share where somebody wears a headset.
function watchServer(page) {
  let lost = false;
  setInterval(async () => {
    const there = await fetch('alive').then((answer) => answer.ok && answer.json(), () => false);
    if (there.pages || page.viewer.session) page.sharing ??= import('./share.js').then(({ Share }) => (page.share = new Share(page)));
    if (page.viewer.view.studio) return;
    if (there && lost) location.reload();
    if (!there && !lost) page.fail('ods view has ended. Start it again, and this page goes on by itself.');
    lost = !there;
  }, 2000);
}

async function start() {
  const answer = await fetch('view.json');
  if (!answer.ok) throw new Error(`view.json did not load (${answer.status}). Open the address that ods view printed.`);
  const view = await answer.json();
  const wanted = readState(location.hash);
  const viewer = new Viewer(find('picture'), view, await loadShader(), location.href);
  const page = new Page(viewer, wanted);
  viewer.set({ fov: page.fov(), ...wanted.look });
  viewer.addEventListener('open', () => {
    page.fail('');
    if (page.frame) viewer.picture.seek?.((page.frame + 0.5) / viewer.picture.fps);
    page.frame = 0;
  });
  viewer.addEventListener('failed', ({ detail }) => page.fail(detail));
  followPointer(viewer);
  watchKeys(page);
  watchIdle();
  watchGrid(viewer);
  watchAddress(page);
  if (view.live) watchServer(page);
  hasHeadset().then((has) => (document.querySelector('#tools [data-action="headset"]').hidden = !has));
  find('starting').remove();
  find('picture').focus({ preventScroll: true });
  window.omnistereo = page; // for tests, and for the console
  if (view.items.length) await viewer.open(Math.min(wanted.item, view.items.length - 1), wanted.choice);
  else if (!view.studio) page.fail('There is no picture here. Name one: ods view picture.png');
  if (view.studio) (await import('./studio.js')).startStudio(page);
}

start().catch((error) => {
  find('starting')?.remove();
  find('message').textContent = error.message;
  find('message').hidden = false;
});
