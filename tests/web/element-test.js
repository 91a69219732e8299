// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// <stereo-360> in pages that have many of them, forbid things, or show it on phones. Each test throws what is wrong.
import { expect, sleep, until } from './wait.js';

const frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

function makeElement(attributes = {}, size = [64, 36]) {
  const element = document.createElement('stereo-360');
  for (const [name, value] of Object.entries({ item: 0, ...attributes })) element.setAttribute(name, value);
  Object.assign(element.style, { width: `${size[0]}px`, height: `${size[1]}px` });
  return element;
}

// Counts the contexts that a page makes, and those that it loses.
function watchContexts() {
  const all = new Set();
  const found = { made: 0, lost: 0 };
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
    const context = getContext.call(this, kind, ...more);
    if (kind === 'webgl2' && context && !all.has(context)) {
      all.add(context);
      found.made++;
      this.addEventListener('webglcontextlost', () => found.lost++);
    }
    return context;
  };
  return found;
}

// The mean brightness of what an element shows, 0 to 255: of its canvas, or of its last frame.
function brightness({ shadowRoot }) {
  const copy = new OffscreenCanvas(8, 8).getContext('2d');
  for (const canvas of shadowRoot.querySelectorAll('#picture > canvas')) copy.drawImage(canvas, 0, 0, 8, 8);
  return copy.getImageData(0, 0, 8, 8).data.reduce((sum, value, i) => sum + (i % 4 < 3 ? value : 0), 0) / 192;
}

const isQuiet = ({ shadowRoot }) => shadowRoot.getElementById('message')?.hidden ?? true;

// Sixty panoramas below each other: each appears when it comes into view, at most eight use the GPU.
async function testMany() {
  const contexts = watchContexts();
  const elements = Array.from({ length: 60 }, () => makeElement({}, [64, 140]));
  document.body.append(...elements);
  for (const element of elements.filter((_, i) => i % 20 === 19)) {
    element.scrollIntoView();
    await until(() => element.loaded && brightness(element) > 60, 'loads when it comes into view');
    await sleep(300); // its neighbours load, too
    expect(element.loaded, `number ${elements.indexOf(element)} sleeps, although it is seen`);
    expect(brightness(element) > 60, `number ${elements.indexOf(element)} is dark: ${brightness(element)}`);
  }
  expect(contexts.made <= 8 && contexts.lost === 0, `${contexts.made} contexts, ${contexts.lost} lost`);
  elements[19].lookAt({ yaw: 70 });
  elements[19].scrollIntoView();
  await until(() => elements[19].loaded && !elements[59].loaded, 'returns');
  expect(elements[19].yaw === 70, 'it forgot where it looked');
  expect(brightness(elements[59]) > 60, 'what left the view does not keep its last frame');
  await frame();
  expect(contexts.made <= 8 && contexts.lost === 0, `${contexts.made} contexts, ${contexts.lost} lost`);
  expect(elements.every(isQuiet), 'an element displays a message');
  elements.forEach((element) => element.remove());
}

// Twelve in view at once: all have a picture, those touched last are alive.
async function testGrid() {
  const contexts = watchContexts();
  const elements = Array.from({ length: 12 }, () => makeElement());
  elements.forEach((element) => (element.style.display = 'inline-block'));
  document.body.append(...elements);
  await until(() => elements.every((element) => brightness(element) > 60 && isQuiet(element)), 'shows all');
  expect(contexts.made <= 8 && contexts.lost === 0, `${contexts.made} contexts, ${contexts.lost} lost`);
  const asleep = elements.find((element) => !element.loaded);
  asleep.shadowRoot.getElementById('player').dispatchEvent(new PointerEvent('pointerenter'));
  await until(() => asleep.loaded, 'wakes what is touched');
  expect(elements.filter((element) => element.loaded).length <= 8, 'too many are awake');
  elements.forEach((element) => element.remove());
}

// One element mounted a hundred times, and a hundred elements, one after another, as apps do.
async function testMounted() {
  const contexts = watchContexts();
  const one = makeElement({ loading: 'eager' });
  for (let i = 0; i < 100; i++) {
    document.body.append(one);
    if (i % 20 === 0) await until(() => one.loaded, 'loads again');
    else await sleep(i % 3);
    one.remove();
    expect(!one.loaded, 'it keeps its picture');
  }
  for (let i = 0; i < 100; i++) {
    const other = makeElement({ loading: 'eager' });
    document.body.append(other);
    if (i % 20 === 0) await until(() => other.loaded, 'loads');
    else await sleep(i % 3);
    other.remove();
  }
  document.body.append(one);
  await until(() => one.loaded && brightness(one) > 60, 'loads in the end');
  expect(isQuiet(one) && contexts.made <= 1 && contexts.lost === 0, `${contexts.made} contexts, ${contexts.lost} lost`);
  one.remove();
}

// A context that something else has ended: "Try again" shows a picture.
async function testLost() {
  const element = makeElement({ loading: 'eager' });
  document.body.append(element);
  await until(() => element.loaded, 'loads');
  element.viewer.panorama.gl.getExtension('WEBGL_lose_context').loseContext();
  await until(() => !isQuiet(element) && !element.loaded, 'says that it lost its picture');
  element.shadowRoot.getElementById('again').click();
  await until(() => element.loaded && isQuiet(element), 'tries again');
  await frame();
  expect(brightness(element) > 60, 'it stays dark');
  element.remove();
}

// The longer side of a view is 90 degrees, also after the device was turned.
async function testUpright() {
  const element = makeElement({ loading: 'eager' }, [90, 190]);
  document.body.append(element);
  await until(() => element.loaded, 'loads');
  const angles = () => {
    const [{ rays, box }] = element.viewer.parts(0);
    expect(Math.abs(Math.hypot(...rays.slice(0, 3)) / Math.hypot(...rays.slice(3, 6)) - box[2] / box[3]) < 1e-6, 'pixels are no squares');
    return [0, 3].map((i) => Math.round(2 * Math.atan(Math.hypot(...rays.slice(i, i + 3))) * 180 / Math.PI)).join();
  };
  expect(angles() === '51,90', `upright it is ${angles()}`);
  Object.assign(element.style, { width: '190px', height: '90px' });
  await frame();
  expect(element.fov === 90 && angles() === '90,51', `turned it is ${angles()}`);
  element.remove();
}

// Without a full screen in the browser, the element fills the window; in a frame without permission, the button is hidden.
async function testFullscreen() {
  const allow = (is) => Object.defineProperty(Document.prototype, 'fullscreenEnabled', { get: () => is, configurable: true });
  allow(false);
  const element = makeElement({ loading: 'eager' });
  document.body.append(element);
  await until(() => element.loaded, 'loads');
  const button = element.shadowRoot.querySelector('[data-action="fullscreen"]');
  const isFull = () => element.getBoundingClientRect().width >= document.documentElement.clientWidth && element.getBoundingClientRect().height >= innerHeight;
  expect(!button.hidden, 'no button');
  button.click();
  await frame();
  expect(isFull() && element.viewer.canvas.clientHeight === innerHeight, 'it does not fill the window');
  element.viewer.canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true, composed: true }));
  await frame();
  expect(!isFull() && document.documentElement.style.overflow === '', 'Escape does not lead back');
  button.click();
  element.remove();
  expect(document.documentElement.style.overflow === '', 'the page cannot be scrolled any more');
  const frameElement = document.body.appendChild(document.createElement('iframe'));
  const srcdoc = '<script src="stereo-360.js"></script><stereo-360 item="0" loading="eager"></stereo-360>'; // servers forbid frames
  Object.assign(frameElement, { allow: "fullscreen 'none'", srcdoc });
  await until(() => frameElement.contentDocument?.querySelector('stereo-360')?.loaded, 'loads in a frame');
  const inner = frameElement.contentDocument.querySelector('stereo-360').shadowRoot;
  expect(!frameElement.contentDocument.fullscreenEnabled && inner.querySelector('[data-action="fullscreen"]').hidden, 'a frame that may not has the button');
  frameElement.remove();
}

// A page that forbids text as HTML (Trusted Types), and loads the element twice.
async function testStrict() {
  const policy = Object.assign(document.createElement('meta'), { httpEquiv: 'Content-Security-Policy', content: "require-trusted-types-for 'script'; trusted-types 'none'" });
  document.head.append(policy);
  try {
    document.body.innerHTML = '<p></p>';
    expect(false, 'the page does not forbid it');
  } catch (error) {
    expect(error instanceof TypeError, error.message);
  }
  const element = makeElement({ loading: 'eager' });
  document.body.append(element);
  await until(() => element.loaded, 'loads');
  element.player.act('settings');
  await frame();
  expect(element.shadowRoot.querySelectorAll('#bar button svg path').length >= 4 && element.shadowRoot.getElementById('settings').matches(':popover-open'), 'it is empty');
  element.remove();
}

// Every text is in every language.
async function testTranslations() {
  const { LANGUAGES } = await import('./src/translate.js');
  const { ACTIONS } = await import('./src/actions.js');
  const { MODES, WORN } = await import('./src/modes.js');
  const texts = new Set(['A panorama']);
  const { MOVES } = await import('./src/layered.js');
  const { OBJECT_KEYS } = await import('./src/objects.js');
  for (const { label, group } of [...ACTIONS, ...MOVES, ...OBJECT_KEYS]) if (label) texts.add(label).add(group);
  for (const { label, visitors } of [...MODES, ...WORN]) texts.add(label).add(visitors ?? label);
  for (const file of ['actions', 'compare', 'controls', 'faults', 'help', 'list', 'main', 'system-player', 'tour', 'tour-ways', 'tour-worn', 'headset-controls', 'headset-guide', 'headset-panel', 'markup', 'notes', 'player', 'stereo-360', 'tour-plan']) {
    const source = await (await fetch(`src/${file}.js`)).text();
    for (const [, one, other] of source.matchAll(/\bt\((?:[^()'`]*\? )?'([^']*)'(?: : '([^']*)')?/g)) texts.add(one).add(other ?? one);
    if (file === 'faults') for (const [, text] of source.matchAll(/'([A-Z][^']*\.)'/g)) texts.add(text);
  }
  expect(texts.size > 90 && Object.keys(LANGUAGES).join() === 'de,fr', `${texts.size} texts`);
  for (const [language, load] of Object.entries(LANGUAGES)) {
    const { TRANSLATIONS } = await load();
    const missing = [...texts].filter((text) => !TRANSLATIONS[text]);
    expect(missing.length === 0, `${language} lacks ${missing.join(' | ')}`);
    const holes = (text) => text.split('{}').length;
    for (const [text, own] of Object.entries(TRANSLATIONS)) expect(holes(text) === holes(own), `${language}: ${own} has other values than ${text}`);
  }
}

// Visitors see an invitation and the bar until they drag, a mark that says what it is, and none of the makers' tools.
async function testVisitors() {
  document.documentElement.lang = 'de';
  localStorage.clear();
  const element = makeElement({ loading: 'eager', 'aria-label': 'Hafen' }, [480, 270]);
  document.body.append(element);
  await until(() => element.loaded, 'loads');
  const find = (id) => element.shadowRoot.getElementById(id);
  const shown = () => [...find('bar').querySelectorAll('button, select')].filter((each) => each.checkVisibility()).map((each) => each.dataset.action ?? each.id);
  expect(find('mark').textContent === '360° 3D' && find('mark').checkVisibility(), `the mark says ${find('mark').textContent}`);
  expect(shown().join() === 'mode,fullscreen', `the bar has ${shown()}`);
  expect([...find('mode').options].map(({ text }) => text).join() === 'Flach,3D nebeneinander,3D rot und cyan,3D im Wechsel', 'other modes, or in another language');
  expect(!find('hint').hidden && find('hint').textContent.includes('Ziehen'), 'no invitation');
  await sleep(3300);
  expect(!find('player').classList.contains('idle'), 'the bar fades before anything was touched');
  element.viewer.element.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true, composed: true }));
  expect(find('hint').hidden && find('mark').checkVisibility(), 'the invitation stays, or the mark does not');
  await until(() => find('player').classList.contains('idle'), 'fades');
  // A video has no tools for makers, either.
  find('film').hidden = false;
  find('time').append(document.createElement('span'));
  find('time').lastChild.textContent = 'frame 0';
  expect(shown().join() === 'play,mode,fullscreen' && !find('time').lastChild.checkVisibility(), `the bar of a video has ${shown()}`);
  element.remove();
  const makers = makeElement({ loading: 'eager', controls: 'all' }, [640, 360]);
  document.body.append(makers);
  await until(() => makers.loaded, 'loads');
  expect(makers.shadowRoot.querySelector('#bar [data-action="swap"]').checkVisibility() && makers.shadowRoot.getElementById('hint').hidden, 'no tools for makers, or a second invitation');
  makers.remove();
  document.documentElement.lang = 'en';
}

// Plays Safari on visionOS, whose pictures have controls: a tagged file has a button for them. Elsewhere nothing changes.
async function testTagged() {
  const about = { loading: 'eager', src: 'item/0/picture.png', tagged: '' };
  const open = async (attributes) => {
    const element = makeElement(attributes, [480, 270]);
    document.body.append(element);
    await until(() => element.loaded, 'loads');
    return [element, element.shadowRoot.querySelector('#bar [data-action="system"]')];
  };
  const [other, none] = await open(about);
  expect(!none.checkVisibility(), 'a browser without such controls offers them');
  other.remove();
  Object.defineProperty(HTMLImageElement.prototype, 'controls', { configurable: true, value: false, writable: true });
  const [untagged, no] = await open({ loading: 'eager', src: about.src });
  expect(!no.checkVisibility(), 'a file without tags has a button');
  untagged.remove();
  const [element, button] = await open(about);
  expect(button.checkVisibility() && button.ariaLabel, 'a tagged file has no button');
  button.click();
  const shown = () => element.shadowRoot.querySelector('#system > img');
  await until(shown, 'opens');
  expect(shown().hasAttribute('controls') && shown().src === new URL(about.src, document.baseURI).href, 'another picture, or no controls');
  element.shadowRoot.querySelector('#system > button').click();
  expect(!shown() && element.loaded, 'it does not close');
  element.remove();
  delete HTMLImageElement.prototype.controls;
}

// HLS is the browser's: one that does not play it gets one line that says what to do.
async function testStreams() {
  const { canPlayType } = HTMLMediaElement.prototype;
  HTMLMediaElement.prototype.canPlayType = () => '';
  const element = makeElement({ loading: 'eager', src: 'film.m3u8' });
  let said = '';
  element.addEventListener('error', ({ detail }) => (said = detail.message));
  document.body.append(element);
  await until(() => said, 'says what is wrong');
  expect(said === 'film.m3u8 is HLS, which this browser does not play. Name an .mp4 of the same film', said);
  said = '';
  HTMLMediaElement.prototype.canPlayType = () => 'maybe'; // now it tries
  element.startAgain();
  await until(() => said, 'tries to load it');
  expect(!/HLS/.test(said), said);
  HTMLMediaElement.prototype.canPlayType = canPlayType;
  element.remove();
}

const TESTS = { tagged: testTagged, streams: testStreams, translations: testTranslations, visitors: testVisitors, mounted: testMounted, upright: testUpright, many: testMany, grid: testGrid, fullscreen: testFullscreen, lost: testLost, strict: testStrict };

export const testElements = (name) => TESTS[name]();
