// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// node share_clock.mjs WEB URL: two pages of web/share.js share what they show while a third says a time far ahead. Prints
// how many of four changes then reach the other page.
const [web, url] = process.argv.slice(2);
const { Share } = await import(new URL('share.js', `file://${web}/`));
const sleep = (time) => new Promise((done) => setTimeout(done, time));

// What share.js asks of a browser and of the viewer.
const plainFetch = globalThis.fetch;
globalThis.fetch = (address, options) => plainFetch(new URL(address, url), options);
globalThis.document = { createElement: () => ({ addEventListener() {}, setAttribute() {}, remove() {} }) };
globalThis.requestAnimationFrame = (run) => setTimeout(run, 16);
function openPage() {
  const viewer = {
    item: 0, choice: {}, session: null, picture: null, view: { items: [{}] },
    state: { swap: false, yaw: 0, pitch: 0, roll: 0 },
    element: { addEventListener() {}, append() {}, after() {} }, canvas: { after() {} },
    set(changes) { Object.assign(this.state, changes); },
    open() {},
  };
  return new Share({ viewer });
}

const pages = [openPage(), openPage()];
const shown = () => pages.map(({ viewer }) => viewer.state.swap);
async function reach(value) {
  for (let i = 0; i < 50 && !shown().every((swap) => swap === value); i++) await sleep(100);
  await sleep(200); // nobody takes it back
  return shown().every((swap) => swap === value);
}

await sleep(1500);
for (const clock of [1e300, 9e15, '7', null, -1]) {
  const body = JSON.stringify({ fields: { swap: { value: false, clock, by: 'zzzzzzzzzzzz' } } });
  await fetch('share?id=0', { method: 'POST', body });
}
await sleep(1000);
let reached = 0;
for (let i = 0; i < 4; i++) {
  const value = i % 2 === 0;
  pages[i % 2].viewer.state.swap = value;
  reached += await reach(value);
}
console.log(`${reached} of 4 changes reach the other page`);
process.exit(0);
