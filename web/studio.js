// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio: the viewer shows a scene that the server renders live, and a panel beside it changes every option. Two
// settings, A and B, can be compared. main.js starts it if view.json has `studio`.
import { ACTIONS } from './actions.js';
import { nameButtons } from './controls.js';
import { icon } from './icons.js';
import { modeOf } from './modes.js';
import { angleAcross } from './panorama.js';
import { Live } from './studio-live.js';
import { make } from './elements.js';
import { Panel } from './studio-panel.js';
import { pickWithClicks } from './studio-pick.js';
import { RenderFoot } from './studio-render.js';
import { ENDED, Session, ask, sleep } from './studio-session.js';
import { Walk } from './studio-walk.js';

const LOOK_PAUSE = 100; // milliseconds between messages about the look
const SIDES = ['A', 'B'];
const TURN = 2000; // milliseconds of the first turn of a side in a comparison

// Describes a frame and the next one. A part is the whole picture or, finer, the view.
export function progressOf({ part, width, height, samples, seconds, next }) {
  const what = (each) => (each.part === 'patch' ? 'view' : 'picture');
  const now = `${what({ part })} ${width} × ${height}, ${samples} ${samples === 1 ? 'sample' : 'samples'} per pixel, ${seconds.toFixed(1)} s`;
  if (!next) return `${now}: finished`;
  return `${now}; next: ${what(next)} ${next.width} wide, ${next.samples} samples`;
}

class Studio {
  constructor(page) {
    Object.assign(this, { page, comparing: null });
    const { viewer } = page;
    const { studio } = viewer.view;
    this.live = new Live(viewer.panorama.gl);
    this.scene = { name: studio.scene, kind: 'scene', projection: 'lat-long', layout: 'live' };
    this.session = new Session(studio.settings, () => this.look(), (...frame) => this.take(...frame));
    this.session.isSeen = () => !document.hidden || viewer.session;
    this.walk = new Walk(this);
    this.build();
    this.panel = new Panel(this.rows, viewer.view, this.session);
    this.foot = new RenderFoot(this.element.querySelector('footer'), this);
    viewer.studio = this;
    this.listen();
    this.showScene();
    this.panel.curve.look(viewer.state.pitch);
    this.session.start();
  }

  build() {
    const { page, page: { viewer } } = this;
    const button = (action, name, className = 'small') => make('button', { type: 'button', className, 'data-action': action }, icon(name));
    this.sideButtons = SIDES.map((name, i) => {
      const each = make('button', { type: 'button', className: 'small', textContent: name, 'data-tip': `Settings ${name}`, 'data-key': 'B' });
      each.addEventListener('click', () => page.toast(this.choose(i)));
      return each;
    });
    this.back = make('button', { type: 'button', className: 'back', hidden: true }, icon('previous'), ' Back to the scene');
    this.back.addEventListener('click', () => this.showScene());
    this.status = make('output', { className: 'status' });
    this.rows = make('div', { className: 'rows' });
    this.element = make('aside', { id: 'studio', 'aria-label': 'Studio' },
      make('header', {}, button('panel', 'next', 'fold'),
        make('strong', { textContent: viewer.view.studio.scene, title: viewer.view.studio.scene }),
        button('undo', 'undo'), button('redo', 'redo'),
        make('span', { className: 'sides', role: 'group', 'aria-label': 'Settings A and B' }, ...this.sideButtons, button('split', 'compare'))),
      this.back, this.rows, make('footer', {}));
    this.shade = make('div', { id: 'drop', hidden: true, textContent: 'Drop a scene (.glb), a light (.hdr, .exr) or a camera (.camera.json)' });
    document.head.append(make('link', { rel: 'stylesheet', href: 'studio.css' }));
    page.element.append(this.status);
    document.body.append(this.element, this.shade);
    document.body.classList.add('studio');
  }

  listen() {
    const { page, session } = this;
    const { viewer } = page;
    const isLive = () => viewer.scene;
    const rows = [
      { id: 'pick', keys: ['Enter'], shown: 'Click Enter', label: 'distance and disparity of a thing, of the middle', when: isLive, run: () => this.pickMiddle() },
      { id: 'undo', keys: [], shown: 'Ctrl-Z', label: 'undo', run: () => { session.step(-1); } },
      { id: 'redo', keys: [], shown: 'Ctrl-Shift-Z', label: 'redo', run: () => { session.step(1); } },
      { id: 'swap-sides', keys: ['b'], label: 'settings A or B', run: () => this.choose(1 - session.active) },
      { id: 'split', keys: ['x'], label: 'compare A and B', when: isLive, run: () => this.compare() },
      { id: 'panel', keys: ['i'], label: 'hide or show the panel', run: () => { document.body.classList.toggle('folded'); } },
    ].map((row) => ({ ...row, group: 'Studio' }));
    ACTIONS.splice(-1, 0, ...rows);
    ACTIONS.unshift(...this.walk.keys(isLive)); // first: pictures use these keys otherwise
    nameButtons(this.element);
    this.element.addEventListener('keydown', (event) => {
      if (event.target.matches('input, select') && !event.ctrlKey && !event.metaKey) event.stopPropagation();
    });
    addEventListener('keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z' || !viewer.scene) return;
      event.preventDefault();
      document.activeElement?.matches?.('#studio .number input') && document.activeElement.blur();
      session.step(event.shiftKey ? 1 : -1);
    });
    session.addEventListener('edit', () => this.update());
    session.addEventListener('accepted', ({ detail }) => this.live.renumber(detail));
    session.addEventListener('status', ({ detail }) => this.tell(detail));
    session.addEventListener('restart', () => this.live.expire());
    session.addEventListener('lost', () => page.fail(ENDED));
    session.addEventListener('found', () => page.fail(''));
    viewer.addEventListener('change', () => this.watchLook());
    viewer.addEventListener('open', () => this.update());
    viewer.canvas.addEventListener('webglcontextlost', () => this.live.forget());
    viewer.canvas.addEventListener('webglcontextrestored', () => session.fromStart());
    this.watchDrops();
    this.pickMiddle = pickWithClicks(this);
    this.update();
  }

  update() {
    const { session } = this;
    this.sideButtons.forEach((each, i) => each.setAttribute('aria-pressed', i === session.active));
    const able = (action, is) => (this.element.querySelector(`[data-action="${action}"]`).disabled = !is);
    able('undo', session.side.past.length);
    able('redo', session.side.future.length);
    this.element.querySelector('[data-action="split"]').setAttribute('aria-pressed', Boolean(this.comparing));
    this.back.hidden = Boolean(this.page.viewer.scene);
    document.body.classList.toggle('live', Boolean(this.page.viewer.scene));
    this.refresh();
  }

  tell({ state, done, fault, side, isOthers, ...frame }) {
    this.takeTurns(done, side);
    if (frame.samples) this.page.viewer.expectBetter(!done);
    if (fault) this.page.fail(fault);
    const name = !this.comparing || !side ? '' : `${SIDES[this.session.sides.indexOf(side)]}: `;
    if (isOthers) this.status.textContent = 'Another tab has changed the scene. What you change here counts again.';
    else if (state === 'loading') this.status.textContent = 'Loading the scene …';
    else if (frame.samples) this.status.textContent = name + progressOf(frame);
  }

  // --- display ---

  async take(meta, pixels, side) {
    await this.live.take(meta, pixels, side);
    this.refresh();
  }

  // Displays the present pictures on the GPU.
  refresh() {
    const { viewer } = this.page;
    if (!viewer.scene) return;
    const { sides, active } = this.session;
    const [left, right] = this.comparing ? [sides[0], sides[1]] : [sides[active], null];
    const other = sides[1 - active];
    const has = (side) => (side && this.live.picture(side) ? side : null);
    const first = has(left) ?? has(other) ?? has(sides[active]);
    const name = (side) => SIDES[sides.indexOf(side)];
    if (first && first !== left && first.settings !== left.settings) this.status.textContent = `${name(left)} is being rendered; until then you see ${name(first)}`;
    viewer.picture = first ? this.live.picture(first, has(right) ?? (right && first)) : null;
    this.comparing?.mark(active);
    viewer.redraw();
  }

  showScene() {
    const { viewer } = this.page;
    viewer.loading?.abort();
    viewer.close();
    viewer.item = -1;
    viewer.scene = this.scene;
    this.page.fail('');
    this.refresh();
    viewer.say('loading', null);
    viewer.say('open');
  }

  // Shows a finished rendering.
  async showItem(item) {
    const { viewer } = this.page;
    if (this.comparing) this.compare();
    viewer.compare?.end();
    viewer.view.items = (await (await fetch('view.json')).json()).items;
    viewer.open(item);
  }

  // A name that describes the picture; count: the number of the file of its kind.
  fileName(count) {
    const { view } = this.page.viewer;
    const stem = view.studio.scene.replace(/^.*[\\/]/, '').replace(/\.[^.]*$/, '');
    return `${stem}${count > 1 ? `_${count}` : ''}${this.session.side.end ?? '.png'}`;
  }

  // --- the look ---

  // The number of views side by side.
  halves() {
    return modeOf(this.page.viewer.state.mode).parts(0).length;
  }

  look() {
    const { state, canvas, session } = this.page.viewer;
    const aspect = canvas.width / this.halves() / canvas.height;
    return (session && this.headLook) || { yaw: state.yaw, pitch: state.pitch, fov: angleAcross(state, aspect), aspect };
  }

  async watchLook() {
    this.panel.curve.look(this.page.viewer.state.pitch);
    if (this.looking) return;
    this.looking = true;
    for (let look = this.look(); JSON.stringify(look) !== this.looked; look = this.look()) {
      this.looked = JSON.stringify(look);
      await ask('look', look).catch(() => {});
      await sleep(LOOK_PAUSE);
    }
    this.looking = false;
  }

  // --- A and B ---

  // Makes a side the active one, and reports it.
  choose(i) {
    const { session } = this;
    const isNew = !session.sides[i];
    session.swap(i);
    return isNew ? `Settings ${SIDES[i]}: a copy of ${SIDES[1 - i]} to change` : `Settings ${SIDES[i]}`;
  }

  async compare() {
    if (this.comparing) {
      this.comparing.end();
      this.comparing = null;
      this.update();
      return 'One picture';
    }
    const { Compare } = await import('./compare.js');
    if (this.comparing) return ''; // the key was pressed twice
    const isNew = !this.session.sides[1];
    this.page.viewer.compare?.end(); // the overlay of comfort
    this.comparing = new Compare(this.page, async () => this.page.toast(await this.compare()));
    if (isNew) this.session.swap(1);
    this.update();
    return `A left, B right${isNew ? ': B is a copy of A, change it' : ''}`;
  }

  // While both sides are visible, each is rendered in turn, until it is finished; turns get longer, because a side
  // starts again each time.
  takeTurns(done, side) {
    const { session } = this;
    const [a, b] = session.sides;
    if (!this.comparing || !b || JSON.stringify(a.settings) === JSON.stringify(b.settings)) return;
    const now = performance.now();
    const both = [a.settings, b.settings];
    if (this.turn?.both.some((settings, i) => settings !== both[i]) ?? true) this.turn = { both, since: now, length: TURN, done: new Set() };
    const { turn } = this;
    if (done && side) turn.done.add(side);
    const next = 1 - session.target;
    if (turn.done.has(session.sides[next]) || (!done && now - turn.since < turn.length)) return;
    Object.assign(turn, { since: now, length: next === session.active ? 2 * turn.length : turn.length });
    session.refine(next);
  }

  // --- files dropped on the page ---

  watchDrops() {
    const hasFiles = (event) => event.dataTransfer?.types.includes('Files');
    let depth = 0;
    addEventListener('dragenter', (event) => {
      if (hasFiles(event)) this.shade.hidden = !++depth;
    });
    addEventListener('dragleave', (event) => {
      if (hasFiles(event)) this.shade.hidden = !(depth = Math.max(depth - 1, 0));
    });
    addEventListener('dragover', (event) => hasFiles(event) && event.preventDefault());
    addEventListener('drop', (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      depth = 0;
      this.shade.hidden = true;
      this.drop(event.dataTransfer.files[0]);
    });
  }

  async drop(file) {
    if (!file) return;
    this.panel.complain('');
    this.page.toast(`Sending ${file.name} …`);
    try {
      const { what, settings } = await ask(`drop?name=${encodeURIComponent(file.name)}`, file);
      if (what === 'scene') return location.reload();
      this.showScene();
      if (what === 'environment') this.panel.names[settings.env] = file.name;
      this.session.restart();
      this.session.replace(settings);
      this.page.toast(what === 'camera' ? `Camera of ${file.name}` : `Light of ${file.name}`);
    } catch (error) {
      this.page.toast('');
      this.panel.complain(error.message.includes(file.name) ? error.message : `${file.name}: ${error.message}`);
    }
  }
}

export function startStudio(page) {
  page.studio = new Studio(page);
}
