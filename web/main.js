// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Starts the page: reads view.json, makes the player, and keeps the page's address and its server in step with it.
import { copyText } from './copy.js';
import { forVisitors } from './faults.js';
import { itemName, plainName } from './item-name.js';
import { Panorama } from './panorama.js';
import { Player } from './player.js';
import { findItem, readState, writeState } from './state.js';
import { t, useLanguage } from './translate.js';

const find = (id) => document.getElementById(id);

// The address of the present view.
function addressOf({ viewer, wanted }) {
  const { picture, item, state, choice, view: { items } } = viewer;
  const pin = viewer.compare?.pin;
  const beside = pin && { ...pin, name: items[pin.item]?.name };
  return writeState({ item, name: items[item]?.name, frame: picture?.video?.paused ? picture.frame() : 0, layers: wanted.layers, controls: wanted.controls, look: state, choice, beside });
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
    if (!(await copyText(location.href))) return t('Copy the address of this page: it leads here');
    return viewer.view.live ? 'Link copied. It works as long as ods view runs' : t('Link copied');
  };
  for (const event of ['change', 'open']) viewer.addEventListener(event, () => (timer ??= setTimeout(write, 250)));
  addEventListener('hashchange', async () => {
    if (location.hash === written) return;
    const to = readState(location.hash);
    player.frame = to.frame;
    if (!viewer.scene) await viewer.open(findItem(viewer.view.items, to), to.choice);
    viewer.set(to.look); // a tour has turned it
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
    if (!there && !lost) player.fail('ods view has ended. Start it again, and this page continues by itself.');
    lost = !there;
  }, 2000);
}

async function start() {
  const answer = await fetch('view.json');
  if (!answer.ok) throw new Error(`view.json did not load (${answer.status}). Open the address that ods view printed.`);
  const view = await answer.json();
  await useLanguage();
  const wanted = readState(location.hash);
  const isVisitors = !view.live && !wanted.controls;
  const player = new Player(find('player'), document, { view, base: location.href, wanted, keys: document, isPage: true, isVisitors, nameOf: isVisitors ? plainName : itemName });
  const { viewer } = player;
  viewer.wake(new Panorama());
  player.frame = wanted.frame;
  viewer.set(wanted.look);
  viewer.addEventListener('open', () => {
    if (player.frame) viewer.picture.seek?.((player.frame + 0.5) / viewer.picture.fps);
    player.frame = 0;
    if (wanted.beside) player.compare({ ...wanted.beside, item: findItem(view.items, wanted.beside) }).catch((error) => player.toast(error.message));
    wanted.beside = null;
  });
  watchAddress(player);
  if (view.live) watchServer(player);
  viewer.element.classList.add('quiet'); // the focus has no frame until somebody uses keys
  addEventListener('keydown', () => viewer.element.classList.remove('quiet'), { once: true });
  viewer.element.focus({ preventScroll: true });
  window.omnistereo = player; // for tests, and for the console
  if (view.items.length) await viewer.open(findItem(view.items, wanted), wanted.choice);
  else if (!view.studio) player.fail('There is no picture here. Name one: ods view picture.png');
  if (view.studio) (await import('./studio.js')).startStudio(player);
}

start().catch(({ message: reason }) => {
  const message = find('message') ?? find('player').appendChild(document.createElement('p'));
  Object.assign(message, { id: 'message', textContent: find('player').matches('.visitors') ? forVisitors(reason) : reason, hidden: false });
});
