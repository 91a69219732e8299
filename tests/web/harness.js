// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws looks with the page's own modules and sends them to the server that asks for them: jobs.json is
//   [{ item, choice, width, height, looks: [{ name, eye, yaw, pitch, fov, show, swap }] }, ...]
// where item is an index of view.json. Every look is sent to result/NAME as PNG, the end, or what failed, to done.
import { openPicture } from './picture.js';
import { Panorama, loadShader, raysOf } from './panorama.js';

const json = async (path) => (await fetch(path)).json();
const post = (path, body) => fetch(path, { method: 'POST', body });
const canvas = document.querySelector('canvas');

async function run() {
  const view = await json('view.json');
  const panorama = new Panorama(canvas, await loadShader(location.href));
  for (const { item, choice, width, height, looks } of await json('jobs.json')) {
    Object.assign(canvas, { width, height });
    const picture = await openPicture(panorama, view, view.items[item], { choice });
    picture.refresh?.();
    for (const { name, eye = 0, show, swap, ...look } of looks) {
      panorama.draw(picture, { rays: raysOf(look, width / height), box: [0, 0, width, height], show, eye, swap });
      const png = await new Promise((done) => canvas.toBlob(done));
      await post(`result/${name}`, png);
    }
    picture.free();
  }
}

run().then(() => post('done', 'ok'), (error) => post('done', `${error.message}\n${error.stack}`));
