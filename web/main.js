// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Starts the page: reads view.json, makes the player, and keeps the page's address and its server in step with it.
import { copyText } from './copy.js';
import { loadShader } from './panorama.js';
import { Player } from './player.js';
import { readState, writeState } from './state.js';

const GREETED = 'omnistereo-greeted';
const find = (id) => document.getElementById(id);

// The address of the present view.
function addressOf({ viewer, wanted }) {
  const { picture, item, state, choice } = viewer;
  return writeState({ item, frame: picture?.video?.paused ? picture.frame() : 0, layers: wanted.layers, look: state, choice, beside: viewer.compare?.pin });
}

// Keeps the address up to date, and follows it when the user changes it.
function watchAddress(player) {
  const { viewer } = player;
  let written = location.hash;
  let timer;
  const write = () => {
    timer = undefined;
    written = addressOf(player);
    history.replaceState(null, '', written);
  };
  player.copyLink = async () => {
    write();
    if (!(await copyText(location.href))) return 'Copy the address of this page: it leads here';
    return viewer.view.live ? 'Link copied. It works as long as ods view runs' : 'Link copied';
  };
  for (const event of ['change', 'open']) viewer.addEventListener(event, () => (timer ??= setTimeout(write, 250)));
  addEventListener('hashchange', () => {
    if (location.hash === written) return;
    const to = readState(location.hash);
    viewer.set(to.look);
    player.frame = to.frame;
    if (!viewer.scene) viewer.open(Math.min(to.item, viewer.view.items.length - 1), to.choice);
  });
}

// Reports when the server has ended, and continues when the next one has started at the same address; the studio
// handles this itself. Starts sharing when a headset is worn.
function watchServer(player) {
  let lost = false;
  setInterval(async () => {
    const there = await fetch('alive').then((answer) => answer.ok && answer.json(), () => false);
    if (there.pages || player.viewer.session) player.sharing ??= import('./share.js').then(({ Share }) => (player.share = new Share(player)));
    if (player.viewer.view.studio) return;
    if (there && lost) location.reload();
    if (!there && !lost) player.fail('ods view has ended. Start it again, and this page goes on by itself.');
    lost = !there;
  }, 2000);
}

// Greets first-time visitors, until they have moved the picture.
function greet(player) {
  const hint = find('hint');
  try {
    if (localStorage.getItem(GREETED)) return;
  } catch {
    return; // the browser does not store anything, so the greeting would appear every time
  }
  const touches = matchMedia('(pointer: coarse)').matches;
  hint.textContent = touches ? 'Drag to look around, pinch to zoom' : 'Drag to look around, wheel to zoom, ? for all keys';
  hint.hidden = false;
  const end = () => {
    hint.hidden = true;
    try {
      localStorage.setItem(GREETED, '1');
    } catch { /* then it will be there again */ }
  };
  for (const event of ['pointerdown', 'wheel', 'keydown']) document.addEventListener(event, end, { once: true, passive: true });
}

async function start() {
  const answer = await fetch('view.json');
  if (!answer.ok) throw new Error(`view.json did not load (${answer.status}). Open the address that ods view printed.`);
  const view = await answer.json();
  const wanted = readState(location.hash);
  const player = new Player(find('player'), document, { view, shader: await loadShader(), base: location.href, wanted, keys: document, isPage: true });
  const { viewer } = player;
  player.frame = wanted.frame;
  viewer.set({ fov: player.fov(), ...wanted.look });
  viewer.addEventListener('open', () => {
    if (player.frame) viewer.picture.seek?.((player.frame + 0.5) / viewer.picture.fps);
    player.frame = 0;
    if (wanted.beside && viewer.view.items[wanted.beside.item]) player.compare(wanted.beside).catch((error) => player.toast(error.message));
    wanted.beside = null;
  });
  watchAddress(player);
  if (view.live) watchServer(player);
  viewer.canvas.focus({ preventScroll: true });
  window.omnistereo = player; // for tests, and for the console
  greet(player);
  if (view.items.length) await viewer.open(Math.min(wanted.item, view.items.length - 1), wanted.choice);
  else if (!view.studio) player.fail('There is no picture here. Name one: ods view picture.png');
  if (view.studio) (await import('./studio.js')).startStudio(player);
}

start().catch((error) => {
  const message = find('message') ?? find('player').appendChild(document.createElement('p'));
  Object.assign(message, { id: 'message', textContent: error.message, hidden: false });
});
