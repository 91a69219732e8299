// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shows two pictures in the same view, with a movable line between them, alternating, or as their difference. The one
// to the right of the line is `picture.beside` (panorama.js); in the studio it shows the settings B.
import { clamp } from './geometry.js';
import { make } from './elements.js';
import { icon } from './icons.js';
import { modeOf } from './modes.js';
import { openPicture } from './picture.js';
import { t } from './translate.js';

const BLINK = 600; // milliseconds
const STEP = 0.02; // fraction of the view per key press
const LEVELS = ['caution', 'warn', 'error'];
const WAYS = [['slider', 'Slider'], ['blink', 'Blink'], ['difference', 'Difference ×4']];

export class Compare {
  // end(): closes the comparison.
  constructor(player, end) {
    Object.assign(this, { player, viewer: player.viewer, way: 'slider', split: 0.5, other: null, names: ['A', 'B'], timer: 0, isOther: false });
    const difference = make('canvas', { hidden: true });
    const divider = make('div', { id: 'divider', tabIndex: 0, role: 'separator', 'aria-orientation': 'vertical', 'aria-valuemin': 0, 'aria-valuemax': 100 }, make('span'), make('span'));
    const close = make('button', { type: 'button', ariaLabel: t('End the comparison'), 'data-tip': t('End the comparison'), 'data-key': 'X' }, icon('close'));
    const ways = WAYS.map(([way, label]) => make('button', { type: 'button', 'data-way': way, textContent: t(label) }));
    const element = make('div', { id: 'compare' }, difference, divider, make('div', { id: 'ways', role: 'group', ariaLabel: t('Compare') }, ...ways, close));
    Object.assign(this, { element, difference, divider });
    element.querySelector('#ways').addEventListener('click', ({ target }) => {
      const button = target.closest('button');
      if (!button) return;
      if (button.dataset.way) this.use(button.dataset.way);
      else end();
    });
    this.drag();
    this.follow = () => this.place();
    player.viewer.element.after(element);
    for (const event of ['change', 'open']) this.viewer.addEventListener(event, this.follow);
    this.watcher = new ResizeObserver(this.follow);
    this.watcher.observe(this.viewer.element);
    this.viewer.compare = this;
    this.use('slider');
  }

  end() {
    clearInterval(this.timer);
    for (const event of ['change', 'open']) this.viewer.removeEventListener(event, this.follow);
    this.watcher.disconnect();
    this.element.remove();
    const { viewer } = this;
    viewer.compare = null;
    if (this.other && viewer.picture) viewer.picture.beside = null;
    this.other?.free();
    viewer.redraw();
    viewer.say('change');
  }

  use(way) {
    this.way = way;
    clearInterval(this.timer);
    if (way === 'blink') this.timer = setInterval(() => this.blink(), BLINK);
    for (const button of this.element.querySelectorAll('[data-way]')) button.ariaPressed = String(button.dataset.way === way);
    this.difference.hidden = way !== 'difference';
    this.place();
    this.viewer.redraw();
  }

  blink() {
    this.isOther = !this.isOther;
    this.viewer.redraw();
  }

  // The fraction of the view that shows the left picture.
  splitNow() {
    if (this.way === 'slider') return this.split;
    if (this.way === 'difference') return this.isSecond ? 0 : 1;
    return this.isOther ? 0 : 1;
  }

  // --- called by the viewer around each drawing ---

  before(picture) {
    if (this.other) picture.beside = this.other;
    this.other?.refresh?.();
    picture.split = this.splitNow();
    if (this.way === 'blink') this.mark(picture.split ? 0 : 1);
  }

  after(now, how, rows) {
    if (this.way !== 'difference' || this.isSecond) return;
    const { viewer: { canvas }, difference } = this;
    const { width, height } = canvas;
    if (difference.width !== width || difference.height !== height) Object.assign(difference, { width, height });
    const context = difference.getContext('2d');
    const [low, count] = rows ?? [0, height];
    context.save();
    context.beginPath();
    context.rect(0, height - low - count, width, count);
    context.clip();
    context.drawImage(canvas, 0, 0);
    this.isSecond = true;
    this.viewer.paint(now, how, rows);
    this.isSecond = false;
    context.globalCompositeOperation = 'difference';
    context.drawImage(canvas, 0, 0);
    context.globalCompositeOperation = 'lighter';
    for (let i = 0; i < 2; i++) context.drawImage(difference, 0, 0);
    context.restore();
  }

  // The canvas on screen if it is not the own canvas of the viewer.
  shown() {
    return this.way === 'difference' ? this.difference : null;
  }

  // --- the line ---

  // Marks which of the names is visible.
  mark(which) {
    [...this.divider.children].forEach((label, i) => label.classList.toggle('now', i === which));
  }

  place() {
    const { divider, viewer: { element, state }, split } = this;
    const halves = modeOf(state.mode).parts(0).length;
    const isLine = this.way === 'slider';
    divider.classList.toggle('still', !isLine);
    divider.tabIndex = isLine ? 0 : -1;
    divider.style.setProperty('--x', `${((isLine ? split : 0.5) * element.clientWidth) / halves}px`);
    [...divider.children].forEach((label, i) => (label.textContent = this.names[i]));
    divider.ariaLabel = `${this.names[0]} to the left, ${this.names[1]} to the right`;
    divider.ariaValueNow = Math.round(100 * split);
    if (this.way === 'difference') this.mark(-1);
  }

  moveTo(split) {
    this.split = clamp(split, 0, 1);
    this.place();
    this.viewer.redraw();
  }

  drag() {
    const { divider, viewer: { element, state } } = this;
    divider.addEventListener('pointerdown', (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener('pointermove', (event) => {
      if (!divider.hasPointerCapture(event.pointerId)) return;
      const box = element.getBoundingClientRect();
      this.moveTo(((event.clientX - box.left) / box.width) * modeOf(state.mode).parts(0).length);
    });
    divider.addEventListener('keydown', (event) => {
      const by = { ArrowLeft: -STEP, ArrowRight: STEP, PageUp: -5 * STEP, PageDown: 5 * STEP, Home: -1, End: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      this.moveTo(this.split + by);
    });
  }
}

// Puts a picture beside the present one, until it is closed. Later choices change the left one.
class Pinned extends Compare {
  constructor(player, other, name, pin) {
    super(player, () => player.endCompare());
    Object.assign(this, { other, name, pin });
    other.changed = () => this.viewer.redraw();
    this.place();
  }

  // Judges each new picture of the whole scene, one after the other.
  judgeAgain(session) {
    let isJudging = false;
    const follow = async ({ detail }) => {
      if (this.viewer.compare !== this) return session.removeEventListener('status', follow);
      if (detail.part !== 'base' || isJudging) return;
      isJudging = true;
      const found = await judge(this.viewer).catch(() => null);
      isJudging = false;
      if (!found) return;
      const is = this.viewer.compare === this;
      (is ? this.other : found.other).free();
      if (!is) return;
      Object.assign(this, { other: found.other, name: `Comfort: ${found.level}` });
      this.place();
      this.viewer.redraw();
    };
    session.addEventListener('status', follow);
  }

  place() {
    const { viewer, name } = this;
    if (name) this.names = [viewer.scene?.name ?? nameOf(viewer, viewer.item, viewer.choice), name];
    super.place();
    this.keepTime();
  }

  // Keeps two videos at the same time.
  keepTime() {
    const [ours, theirs] = [this.viewer.picture?.video, this.other?.video];
    if (!ours || !theirs) return;
    if (ours.paused !== theirs.paused) ours.paused ? theirs.pause() : theirs.play().catch(() => {});
    const apart = Math.abs(ours.currentTime - theirs.currentTime);
    if (apart > (ours.paused ? 0.01 : 0.2) && !theirs.seeking) this.other.seek(ours.currentTime);
    theirs.muted = true;
  }
}

const nameOf = ({ view }, item, choice) => [view.items[item]?.name, ...Object.values(choice).filter((value) => value !== undefined)].join(', ');

// pin: { item, choice }, an item of view.json and how it is opened; the present picture if missing.
export async function startCompare(player, pin) {
  const { viewer } = player;
  const { item, choice } = pin ?? viewer;
  const other = await openPicture(viewer.panorama, viewer.view, viewer.view.items[item], { base: viewer.base, choice });
  return new Pinned(player, other, nameOf(viewer, item, choice), { item, choice });
}

// The verdict of `ods comfort` on the present picture, and its overlay: cli/view/comfort_layer.h; for the studio's
// scene cli/view/comfort_answers.h.
async function judge({ about, base, scene, panorama, view }) {
  const at = new URL(scene ? 'studio/' : (about.image ?? about.left), base);
  const answer = await fetch(new URL(scene ? 'comfort' : 'comfort.json', at));
  if (!answer.ok) throw new Error((await answer.text()).trim().split('\n')[0]);
  const verdict = await answer.json();
  if (!verdict) throw new Error('There is no picture yet');
  const [left, right] = ['left', 'right'].map((eye) => new URL(scene ? `heat.png?eye=${eye}` : `comfort-${eye}.jpg`, at).href);
  const item = { name: 'Comfort', kind: 'picture', left, right, layout: 'separate', camera: verdict.camera };
  return { ...verdict, other: await openPicture(panorama, view, item, { base }) };
}

// Explains the colours instead of offering the difference, which would be meaningless; and links to the worst place.
function explain({ element, player, viewer }, { worst, text }) {
  const difference = element.querySelector('[data-way="difference"]');
  if (worst) {
    const button = make('button', { type: 'button', 'data-tip': 'Look at what strains the eyes most' }, 'Worst place');
    button.addEventListener('click', (event) => {
      event.stopPropagation();
      viewer.set(worst);
      player.toast(text);
    });
    difference.before(button);
  }
  difference.before(make('span', { className: 'legend' }, ...LEVELS.map((level) => make('span', { className: level }, level))));
  difference.remove();
}

// Shows over the picture where it strains the eyes. The line starts at the left edge; moving it hides the overlay. In
// the studio the overlay follows changes.
export async function showComfort(player) {
  const { viewer, studio } = player;
  const { item } = viewer;
  const verdict = await judge(viewer);
  const { text, level, other } = verdict;
  if (viewer.compare || viewer.item !== item) return other.free(); // it was changed meanwhile
  const compare = new Pinned(player, other, `Comfort: ${level}`, null);
  explain(compare, verdict);
  compare.moveTo(0);
  viewer.addEventListener('loading', () => viewer.compare === compare && compare.end(), { once: true });
  if (viewer.scene) compare.judgeAgain(studio.session);
  return text;
}
