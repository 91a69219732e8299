// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio's panel: the rows of studio-fields.js, which follow the session and change it, and the merge's curve.
import { make } from './elements.js';
import { icon } from './icons.js';
import { MergeCurve } from './merge-curve.js';
import { MODE, groupsOf, limitsOf, readValue } from './studio-fields.js';
import { choiceRow, numberRow } from './studio-number.js';
import { ask } from './studio-session.js';

const REST = 400; // milliseconds without a new picture of the whole sphere
const LENGTHS = { longitude: 2, latitude: 2, sensor: 2, polynomial: 5, axis: 3 };
const LIST = /^(?<list>.*\.(?<name>longitude|latitude|sensor|polynomial|axis))\.(?<i>\d)$/; // these may be missing
const LIMIT = 25.6; // minutes of arc: of --merge auto
const LINK = /^sidecar\.merge_(top|bottom)\./;
const numbersOfProjection = ['longitude', 'latitude', 'fov', 'aspect', 'pan', 'tilt', 'sensor', 'polynomial'];

export class Panel {
  // element: where to build it. view: view.json.
  constructor(element, view, session) {
    Object.assign(this, { element, view, session, rows: [], names: { map: 'Map' } }); // names of values for users
    const { merge_top: top, merge_bottom: bottom } = session.settings.sidecar;
    this.linked = JSON.stringify(top) === JSON.stringify(bottom);
    element.replaceChildren(...groupsOf(view).map((group) => this.group(group)));
    // Placed beside the panel, which may be hidden.
    this.said = make('span', {});
    const close = make('button', { type: 'button', className: 'small', 'data-tip': 'Close', 'aria-label': 'Close' }, icon('close'));
    close.addEventListener('click', () => this.complain(''));
    this.fault = make('div', { id: 'fault', role: 'alert', hidden: true }, this.said, close);
    document.body.append(this.fault);
    session.addEventListener('edit', () => this.update());
    session.addEventListener('accepted', () => this.isOfSettings && this.refuse(''));
    session.addEventListener('refused', ({ detail }) => this.refuse(detail.text, detail.paths));
    session.addEventListener('status', ({ detail }) => {
      if (detail.part !== 'base') return;
      detail.side.merge = detail.merge;
      this.draw();
      clearTimeout(this.resting);
      if (!session.settings.merge_limit) this.resting = setTimeout(() => this.followDepth(), REST);
    });
    this.update();
  }

  group({ name, open = false, rows, top, bottom }) {
    const body = top ? this.merge(top, bottom) : rows.map((row) => this.row(row));
    return make('details', { open }, make('summary', {}, icon('down'), name), ...body);
  }

  merge(top, bottom) {
    this.curve = new MergeCurve(this.view.studio.kernel_merges, (...drag) => this.dragCurve(...drag));
    const box = make('input', { type: 'checkbox', checked: this.linked });
    box.addEventListener('change', () => {
      this.linked = box.checked;
      if (this.linked) this.session.edit({ 'sidecar.merge_bottom': this.session.settings.sidecar.merge_top });
      this.update();
    });
    this.box = box;
    const link = make('label', { className: 'check' }, box, ' Same above and below');
    this.useAuto = make('button', { type: 'button', className: 'small', textContent: 'Use the dotted curve', hidden: true, 'data-tip': 'As much eye distance as the depth of the picture allows: --merge auto' });
    this.useAuto.addEventListener('click', () => this.session.edit({ merge_limit: LIMIT }));
    this.titles = ['Above', 'Below'].map((textContent) => make('h3', { textContent }));
    this.below = make('div', {}, this.titles[1], ...bottom.map((row) => this.row({ ...row, name: `Below: ${row.label}` })));
    return [this.curve.element, this.useAuto, link, this.titles[0], ...top.map((row) => this.row(row)), this.below];
  }

  row(spec) {
    if (spec.parts) {
      const parts = make('div', { className: 'parts' }, ...spec.parts.map((part) => this.row({ ...part, when: spec.when })));
      return make('div', { className: 'many', role: 'group', 'aria-label': spec.label }, make('span', { textContent: spec.label }), parts);
    }
    const change = (value, gesture = null, dragging = false) => this.change(spec, value, gesture, dragging);
    const reset = () => this.change(spec, this.standard(spec), null, false);
    const control = spec.options ? choiceRow({ ...spec, names: this.names }, change, reset) :
      numberRow({ ...spec, limits: limitsOf(this.view.studio.ranges, spec) }, change, reset, (text) => this.complain(text));
    if (spec.name) control.element.querySelector('input, select').setAttribute('aria-label', spec.name);
    control.element.dataset.path = spec.path;
    this.rows.push({ spec, control });
    return control.element;
  }

  // The default of a row: the settings that the server started with; for numbers of another projection, that
  // projection's.
  standard({ path }) {
    const { settings } = this.view.studio;
    const now = this.session.settings;
    const other = LINK.test(path) || now.sidecar.projection.name === settings.sidecar.projection.name || !/projection\.[^n]/.test(path);
    return readValue(this.view, other ? settings : { sidecar: { projection: { name: now.sidecar.projection.name } } }, path);
  }

  change({ path, projection, write, edits }, value, gesture, dragging) {
    if (edits) {
      this.session.edit(edits(value), gesture, dragging);
      return this.update(); // a choice that changes nothing returns to what is so
    }
    if (MODE.test(path) && value === 'auto') return this.session.edit({ merge_limit: LIMIT });
    const values = { [path]: write ? write(value) : value };
    if (MODE.test(path)) values.merge_limit = null;
    const merge = this.linked && LINK.exec(path);
    if (merge) values[path.replace('merge_top', 'merge_bottom')] = value;
    if (projection) {
      for (const name of numbersOfProjection) values[`sidecar.projection.${name}`] = undefined;
      values['sidecar.picture.layout'] = value === 'vr180' ? 'side-by-side' : this.view.studio.settings.sidecar.picture.layout;
    }
    const index = LIST.exec(path);
    if (index) {
      const { list, name, i } = index.groups;
      const numbers = Array.from({ length: LENGTHS[name] }, (_, each) => readValue(this.view, this.session.settings, `${list}.${each}`));
      numbers[i] = value;
      delete values[path];
      values[list] = numbers;
    }
    this.session.edit(values, gesture, dragging);
  }

  dragCurve(which, end, elevation, gesture, dragging) {
    const merge = this.session.settings.sidecar[`merge_${which}`];
    const value = end === 'start' ? Math.min(elevation, merge.end - 1) : Math.max(elevation, merge.start + 1);
    const values = {};
    for (const each of this.linked ? ['top', 'bottom'] : [which]) values[`sidecar.merge_${each}.${end}`] = value;
    this.session.edit(values, gesture, dragging);
  }

  update() {
    const { settings } = this.session;
    const { merge_top: top, merge_bottom: bottom } = settings.sidecar;
    if (JSON.stringify(top) !== JSON.stringify(bottom)) this.linked = false;
    this.box.checked = this.linked;
    const isAuto = Boolean(settings.merge_limit);
    this.box.parentElement.hidden = isAuto;
    this.below.hidden = this.titles[0].hidden = this.linked || isAuto;
    if (isAuto) this.showAuto([]);
    for (const { spec, control } of this.rows) {
      const hidden = spec.when ? !spec.when(settings) : false;
      control.element.hidden = hidden;
      if (control.element.parentElement.className === 'parts') control.element.parentElement.parentElement.hidden = hidden;
      if (!hidden) control.update(readValue(this.view, settings, spec.path), this.standard(spec));
    }
    this.draw();
  }

  draw() {
    const { sides, active } = this.session;
    const merges = ({ settings: { merge_limit: limit, sidecar: { merge_top: top, merge_bottom: bottom } }, merge: map }) => {
      const of = (merge) => (limit ? { ...merge, mode: 'map' } : merge);
      return { top: of(top), bottom: of(bottom), map };
    };
    this.curve.draw(merges(sides[active]), sides[1 - active] && merges(sides[1 - active]));
  }

  // Draws the dotted curve, or removes it if there are no shares.
  showAuto(shares) {
    this.curve.drawAuto(shares);
    this.useAuto.hidden = !shares.length;
  }

  // The curve that the depth of the picture allows, beside the hand-made one. Computing it takes time from the
  // renderer, so not during changes.
  async followDepth() {
    if (this.isAsking) return;
    this.isAsking = true;
    const comfort = await ask('comfort').catch(() => null);
    if (comfort && !this.session.settings.merge_limit) this.showAuto(comfort.auto);
    this.isAsking = false;
  }

  // Replaces the names of settings in a message by the labels of their rows.
  withLabels(text) {
    const byLength = [...this.rows].sort((a, b) => b.spec.path.length - a.spec.path.length);
    return byLength.reduce((all, { spec }) => all.replaceAll(spec.path.replace('sidecar.', ''), `“${spec.name ?? spec.label}”`), text);
  }

  // Displays an error until it is closed or replaced; '' for none.
  complain(text) {
    this.said.textContent = text;
    this.fault.hidden = !text;
    this.isOfSettings = false;
  }

  // Displays the server's rejection, and marks the rows that cause it.
  refuse(text, paths = []) {
    const marked = this.rows.filter(({ spec }) => paths.some((path) => path === spec.path || path.startsWith(`${spec.path}.`)));
    for (const { control } of this.rows) {
      const is = marked.some((row) => row.control === control);
      control.element.classList.toggle('wrong', is);
      control.element.querySelector('input, select').setAttribute('aria-invalid', is);
    }
    this.complain(this.withLabels(text.replace("'camera' is not a valid camera: ", '')));
    this.isOfSettings = Boolean(text);
    const at = marked.find(({ control }) => !control.element.hidden)?.control.element;
    if (at) at.closest('details').open = true;
  }
}
