// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The bar, the settings and the help: they follow the viewer and control it.
import { ACTIONS, applies, keysOf } from './actions.js';
import { make } from './elements.js';
import { angleOf, hasOtherLayouts } from './form.js';
import { degrees } from './geometry.js';
import { itemName } from './item-name.js';
import { LAYOUTS, PROJECTIONS, TONES } from './formats.js';
import { followDevice, hasDevice } from './look.js';
import { MODES } from './modes.js';
import { widest } from './viewer.js';
import { t } from './translate.js';

const GAP = 8; // pixels

function fill(select, rows) {
  select.replaceChildren(...rows.map(([value, label]) => make('option', { value }, label)));
}

const signed = (value, digits) => `${value < 0 ? '−' : ''}${Math.abs(value).toFixed(digits)}`;
const two = (value) => String(Math.floor(value)).padStart(2, '0');
export const titled = (label) => label.charAt(0).toUpperCase() + label.slice(1);

// Names, tooltips and keys of the buttons in an element, from their actions.
export function nameButtons(element) {
  for (const button of element.querySelectorAll('button[data-action]')) {
    const action = ACTIONS.find(({ id }) => id === button.dataset.action);
    if (!action || button.dataset.tip) continue;
    const label = titled(t(action.label));
    if (!button.textContent.trim()) button.ariaLabel = label;
    Object.assign(button.dataset, { tip: label, key: keysOf(action).slice(0, 1).join('') });
  }
}

export class Controls {
  constructor(player) {
    const { viewer } = player;
    Object.assign(this, { player, viewer, find: (id) => player.find(id) });
    const modes = player.isVisitors ? MODES.filter((mode) => mode.visitors) : MODES;
    fill(this.find('mode'), modes.map(({ name, label, visitors }) => [name, t(player.isVisitors ? visitors : label)]));
    player.element.classList.toggle('visitors', player.isVisitors);
    this.button('device').hidden = !hasDevice();
    fill(this.find('tone'), TONES.map((name) => [name, name]));
    this.find('device-row').hidden = !hasDevice();
    nameButtons(player.element);
    this.listen();
    this.button('fullscreen').hidden = !player.fullscreenWay();
    for (const event of ['change', 'open', 'failed']) viewer.addEventListener(event, () => this.update());
    viewer.addEventListener('open', () => this.describe());
    viewer.addEventListener('loading', ({ detail }) => this.progress(detail));
  }

  listen() {
    const { player, viewer, find } = this;
    (player.isPage ? document : player.element).addEventListener('click', (event) => {
      const button = event.target.closest?.('button[data-action]');
      if (!button) return;
      player.act(button.dataset.action);
      this.giveBack(event);
    });
    const on = (id, event, run) => find(id).addEventListener(event, (what) => {
      run(find(id));
      if (what.type === 'change') this.giveBack(what);
    });
    const video = () => viewer.picture?.video;
    on('mode', 'change', (select) => viewer.set({ mode: select.value }));
    on('layout', 'change', (select) => viewer.choose({ layout: select.value || undefined }));
    on('projection', 'change', (select) => viewer.choose({ projection: select.value || undefined }));
    on('tone', 'change', (select) => viewer.choose({ tone: select.value }));
    on('exposure', 'change', (range) => viewer.choose({ exposure: Number(range.value) }));
    on('exposure', 'input', () => this.label('exposure', `${signed(Number(find('exposure').value), 2)}`));
    on('fov', 'input', (range) => viewer.set({ fov: Number(range.value) }));
    on('shift', 'input', (range) => viewer.set({ shift: Number(range.value) }));
    on('planet', 'change', () => player.act('planet'));
    on('grid', 'change', (box) => viewer.set({ grid: box.checked }));
    on('turn', 'change', (box) => player.turn(box.checked));
    on('loop', 'change', (box) => viewer.picture?.loop?.(box.checked));
    on('seek', 'input', (range) => viewer.picture?.seek?.((Number(range.value) + 0.5) / viewer.picture.fps));
    on('speed', 'change', (select) => video() && (video().playbackRate = Number(select.value)));
    find('device').addEventListener('change', () => this.device(find('device').checked));
    find('settings').addEventListener('submit', (event) => event.preventDefault());
    find('settings').addEventListener('beforetoggle', () => this.update()); // the picture of the studio has no event
    for (const id of ['settings', 'why']) find(id).addEventListener('toggle', () => this.placeSettings());
    const heard = player.isPage ? window : player.element; // an element that is removed leaves nothing
    heard.addEventListener('pointerdown', () => (this.byPointer = true), true);
    heard.addEventListener('keydown', () => (this.byPointer = false), true);
  }

  // Above the right end of the bar, or below it; over it if there is not enough space for everything.
  placeSettings() {
    const [settings, bar] = [this.find('settings'), this.find('bar').getBoundingClientRect()];
    if (!settings.matches(':popover-open')) return;
    const { style } = settings;
    const room = Math.max(bar.top, innerHeight - bar.bottom);
    style.left = `${Math.max(Math.min(bar.right, innerWidth - GAP) - settings.offsetWidth, GAP)}px`;
    const isOver = settings.scrollHeight > room - 2 * GAP;
    style.maxHeight = `${(isOver ? innerHeight : room) - 2 * GAP}px`;
    style.minHeight = isOver ? `${Math.min(innerHeight - bar.top, innerHeight - 2 * GAP)}px` : ''; // its full height
    const isAbove = isOver || bar.top >= room;
    style.bottom = isAbove ? `${isOver ? GAP : innerHeight - bar.top + GAP}px` : 'auto'; // it grows with its content
    style.top = isAbove ? 'auto' : `${bar.bottom + GAP}px`;
  }

  // After a click the picture gets the keyboard focus again; keyboard users keep theirs.
  giveBack({ target }) {
    if (this.byPointer && !target.closest('#settings, dialog, #studio')) this.find('picture').focus({ preventScroll: true });
  }

  async device(is = !this.endDevice) {
    this.endDevice?.();
    this.endDevice = is ? await followDevice(this.viewer) : null;
    this.find('device').checked = Boolean(this.endDevice);
    this.press('device', Boolean(this.endDevice));
    if (is && !this.endDevice) return t('The browser refuses: allow motion sensors for this page');
  }

  label(id, text) {
    this.find(id).nextElementSibling.textContent = text;
  }

  progress(part) {
    const bar = this.find('loading');
    bar.hidden = part === null;
    this.find('spinner').hidden = part === null || Boolean(this.viewer.picture);
    if (part > 0 && part < 1) bar.value = part;
    else bar.removeAttribute('value');
  }

  // Sets the texts that do not change while an item is open.
  describe() {
    const { find, viewer, player } = this;
    const { view, about, choice, picture, item } = viewer;
    const isOneOfMany = view.items.length > 1 && !player.isSingle();
    const name = player.nameOf(about);
    find('folder').hidden = !isOneOfMany;
    find('title').classList.toggle('bare', !name && !isOneOfMany);
    find('name').textContent = name;
    find('count').textContent = !viewer.scene && isOneOfMany ? `${item + 1} / ${view.items.length}` : '';
    find('name').title = name;
    this.mark();
    if (player.isPage && view.live) document.title = `${itemName(about)} – Omnistereo`;
    find('picture').ariaLabel = t('{}. Look around with the arrow keys; ? lists all keys.', name || t('A panorama'));
    find('reason').textContent = choice.layout ? '' : (about.layout_reason ?? '');
    find('why').hidden = !find('reason').textContent;
    const layouts = LAYOUTS.map(({ name }) => [name, name]);
    const hasLayout = hasOtherLayouts(view, about);
    fill(find('layout'), hasLayout ? [['', t('as found: {}', about.layout)], ...layouts] : [['', about.layout ?? t('a file per eye')]]);
    find('layout').disabled = !hasLayout;
    find('layout').value = choice.layout ?? '';
    fill(find('projection'), [['', t('as found: {}', about.projection)], ...PROJECTIONS.map(({ name }) => [name, name])]);
    find('projection').value = choice.projection ?? '';
    for (const id of ['exposure-row', 'tone-row']) find(id).hidden = !about.live;
    const exposure = choice.exposure ?? about.exposure ?? 0;
    find('exposure').value = exposure;
    this.label('exposure', signed(exposure, 2));
    find('tone').value = choice.tone ?? about.tone;
    const isFilm = Boolean(picture?.video);
    find('film').hidden = !isFilm;
    for (const id of ['speed-row', 'loop-row']) find(id).hidden = !isFilm;
    player.element.classList.toggle('film', isFilm);
    if (!isFilm) return;
    const isEndless = !Number.isFinite(picture.frames); // a live stream
    find('seek').hidden = isEndless;
    if (!isEndless) find('seek').max = picture.frames - 1;
    picture.video.playbackRate = Number(find('speed').value);
  }

  update() {
    const { find, viewer: { state, picture }, player } = this;
    find('look').hidden = !state.grid;
    find('look').textContent = `yaw ${signed(state.yaw, 1)}°  pitch ${signed(state.pitch, 1)}°  fov ${state.fov.toFixed(0)}°`;
    find('mode').value = state.mode;
    find('fov').max = widest(state);
    find('fov').value = state.fov;
    find('grid').checked = state.grid;
    find('planet').checked = state.planet;
    find('shift').value = state.shift;
    this.label('shift', `${signed(state.shift, 1)}°`);
    find('turn').checked = Boolean(player.turning);
    this.label('fov', `${state.fov.toFixed(0)}°`);
    this.press('swap', state.swap);
    this.press('compare', Boolean(this.viewer.compare));
    find('shift-row').hidden = Boolean(picture?.mono);
    for (const id of ['layout', 'projection', 'grid', 'planet']) find(`${id}-row`).hidden = Boolean(picture?.lacks?.includes(id));
    for (const id of ['comfort', 'link', 'compare', 'swap', 'system', 'sound']) this.button(id).hidden = !applies(ACTIONS.find((action) => action.id === id), player);
    if (picture?.video) this.film(picture);
  }

  // The mark in a corner, which stays when the bar fades.
  mark() {
    const { picture } = this.viewer; // null before the studio's first one
    const mark = this.find('mark');
    mark.hidden = !this.player.isVisitors || !picture;
    if (!mark.hidden) mark.textContent = `${Math.min(Math.round(degrees(angleOf(picture.camera))), 360)}°${picture.mono ? '' : ' 3D'}`;
  }

  button(action) {
    return this.player.element.querySelector(`button[data-action="${action}"]`);
  }

  press(action, is) {
    this.button(action).ariaPressed = String(is);
  }

  film({ video, fps, frames, frame, loops }) {
    const { find } = this;
    this.player.element.classList.toggle('playing', !video.paused);
    this.button('play').dataset.on = !video.paused;
    this.button('play').ariaLabel = t(video.paused ? 'Play' : 'Pause');
    this.button('sound').dataset.on = !video.muted;
    this.press('sound', !video.muted);
    find('loop').checked = loops;
    const at = frame();
    if (this.player.root.activeElement !== find('seek') || !video.paused) find('seek').value = at;
    const clock = (seconds) => `${Math.floor(seconds / 60)}:${two(seconds % 60)}`;
    this.button('subtitles').hidden = !this.viewer.about.video?.subtitles;
    find('time').replaceChildren(clock(at / fps) + (Number.isFinite(frames) ? ` / ${clock(frames / fps)}` : ''), make('span', {}, video.paused ? `  ${t('frame {}', at)}` : ''));
  }
}
