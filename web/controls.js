// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The bar, the settings and the help: what they show follows the viewer, what they are told goes to it.
import { ACTIONS, keysOf } from './actions.js';
import { hasOtherLayouts } from './form.js';
import { BUTTONS } from './headset.js';
import { followDevice, hasDevice } from './look.js';
import { MODES } from './modes.js';

const find = (id) => document.getElementById(id);

function make(tag, text, ...children) {
  const element = document.createElement(tag);
  if (text !== null) element.textContent = text;
  element.append(...children);
  return element;
}

function fill(select, rows) {
  select.replaceChildren(...rows.map(([value, label]) => {
    const option = make('option', label);
    option.value = value;
    return option;
  }));
}

const signed = (value, digits) => `${value < 0 ? '−' : ''}${Math.abs(value).toFixed(digits)}`;
const two = (value) => String(Math.floor(value)).padStart(2, '0');

export class Controls {
  constructor(page) {
    const { viewer } = page;
    Object.assign(this, { page, viewer });
    fill(find('mode'), MODES.map(({ name, label }) => [name, label]));
    fill(find('tone'), viewer.view.tones.map((name) => [name, name]));
    find('device-row').hidden = !hasDevice();
    this.listen();
    for (const event of ['change', 'open', 'failed']) viewer.addEventListener(event, () => this.update());
    viewer.addEventListener('open', () => this.describe());
    viewer.addEventListener('loading', ({ detail }) => this.progress(detail));
  }

  listen() {
    const { page, viewer } = this;
    document.addEventListener('click', (event) => {
      const button = event.target.closest?.('button[data-action]');
      if (!button) return;
      page.act(button.dataset.action);
      this.giveBack(event);
    });
    const on = (id, event, run) => find(id).addEventListener(event, (what) => {
      run(find(id));
      if (what.type === 'change') this.giveBack(what);
    });
    on('mode', 'change', (select) => viewer.set({ mode: select.value }));
    on('layout', 'change', (select) => viewer.choose({ layout: select.value || undefined }));
    on('projection', 'change', (select) => viewer.choose({ projection: select.value || undefined }));
    on('tone', 'change', (select) => viewer.choose({ tone: select.value }));
    on('exposure', 'change', (range) => viewer.choose({ exposure: Number(range.value) }));
    on('exposure', 'input', () => this.label('exposure', `${signed(Number(find('exposure').value), 2)}`));
    on('fov', 'input', (range) => viewer.set({ fov: Number(range.value) }));
    on('grid', 'change', (box) => viewer.set({ grid: box.checked }));
    on('seek', 'input', (range) => viewer.picture?.seek?.((Number(range.value) + 0.5) / viewer.picture.fps));
    on('speed', 'change', (select) => viewer.picture?.video && (viewer.picture.video.playbackRate = Number(select.value)));
    find('device').addEventListener('change', () => this.device());
    find('settings').addEventListener('submit', (event) => event.preventDefault());
    addEventListener('pointerdown', () => (this.byPointer = true), true);
    addEventListener('keydown', () => (this.byPointer = false), true);
  }

  // After a click the keys are the picture's again; who works by keyboard stays where he is.
  giveBack({ target }) {
    if (this.byPointer && !target.closest('#settings, dialog')) find('picture').focus({ preventScroll: true });
  }

  async device() {
    const box = find('device');
    this.endDevice?.();
    this.endDevice = box.checked ? await followDevice(this.viewer) : null;
    if (box.checked && !this.endDevice) {
      box.checked = false;
      this.page.toast('The browser refuses: allow motion sensors for this page');
    }
  }

  label(id, text) {
    find(id).nextElementSibling.textContent = text;
  }

  progress(part) {
    const bar = find('loading');
    bar.hidden = part === null;
    if (part > 0 && part < 1) bar.value = part;
    else bar.removeAttribute('value');
  }

  // What does not change while an item is open.
  describe() {
    const { view, about, choice, picture, item } = this.viewer;
    find('folder').hidden = view.items.length < 2;
    const many = !this.viewer.scene && view.items.length > 1 ? `  ${item + 1} / ${view.items.length}` : '';
    find('name').textContent = about.name + many;
    find('name').title = about.name;
    document.title = `${about.name} – Omnistereo`;
    find('picture').setAttribute('aria-label', `${about.name}. Look around with the arrow keys; ? lists all keys.`);
    find('reason').textContent = choice.layout ? '' : (about.layout_reason ?? '');
    const layouts = view.layouts.map(({ name }) => [name, name]);
    const hasLayout = hasOtherLayouts(view, about);
    fill(find('layout'), hasLayout ? [['', `as found: ${about.layout}`], ...layouts] : [['', about.layout ?? 'a file per eye']]);
    find('layout').disabled = !hasLayout;
    find('layout').value = choice.layout ?? '';
    fill(find('projection'), [['', `as found: ${about.projection}`], ...view.projections.map(({ name }) => [name, name])]);
    find('projection').value = choice.projection ?? '';
    for (const id of ['exposure-row', 'tone-row']) find(id).hidden = !about.live;
    const exposure = choice.exposure ?? about.exposure ?? 0;
    find('exposure').value = exposure;
    this.label('exposure', signed(exposure, 2));
    find('tone').value = choice.tone ?? about.tone;
    find('film').hidden = !picture?.video;
    document.body.classList.toggle('film', Boolean(picture?.video));
    if (!picture?.video) return;
    find('seek').max = picture.frames - 1;
    picture.video.playbackRate = Number(find('speed').value);
  }

  update() {
    const { state, picture } = this.viewer;
    find('look').textContent = `yaw ${signed(state.yaw, 1)}°  pitch ${signed(state.pitch, 1)}°  fov ${state.fov.toFixed(0)}°`;
    find('mode').value = state.mode;
    find('fov').value = state.fov;
    find('grid').checked = state.grid;
    this.label('fov', `${state.fov.toFixed(0)}°`);
    this.press('swap', state.swap);
    if (picture?.video) this.film(picture);
  }

  press(action, is) {
    for (const button of document.querySelectorAll(`button[data-action="${action}"]`)) button.setAttribute('aria-pressed', is);
  }

  film({ video, fps, frames, frame, loops }) {
    const play = document.querySelector('[data-action="play"]');
    play.dataset.on = !video.paused;
    play.setAttribute('aria-label', video.paused ? 'Play' : 'Pause');
    document.querySelector('[data-action="sound"]').dataset.on = !video.muted;
    this.press('sound', !video.muted);
    this.press('loop', loops);
    const at = frame();
    if (document.activeElement !== find('seek') || !video.paused) find('seek').value = at;
    const clock = (seconds) => `${Math.floor(seconds / 60)}:${two(seconds % 60)}`;
    find('time').textContent = `${clock(at / fps)} / ${clock(frames / fps)}  frame ${at}`;
  }

  fillHelp() {
    const key = (text) => make('kbd', text);
    const rows = ACTIONS.filter(({ label, when }) => label && (!when || when(this.viewer)));
    find('keys').replaceChildren(...rows.map((action) =>
      make('div', null, make('dt', action.label), make('dd', null, ...keysOf(action).flatMap((text) => [key(text), ' '])))));
    find('buttons').replaceChildren(...BUTTONS.map(([what, does]) => make('div', null, make('dt', what), make('dd', does))));
  }
}
