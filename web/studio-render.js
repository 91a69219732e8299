// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The foot of the studio's panel: the command that makes this picture, rendering it, and saving the camera.
import { copyText } from './copy.js';
import { LAYOUTS } from './formats.js';
import { icon } from './icons.js';
import { make } from './elements.js';
import { ENDED, ask, sleep } from './studio-session.js';

const POLL = 300; // milliseconds
const QUALITIES = ['draft', 'preview', 'final'];

function timeOf(seconds) {
  if (seconds < 90) return `${Math.ceil(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

export class RenderFoot {
  // studio: studio.js.
  constructor(element, studio) {
    Object.assign(this, { element, studio, named: false, taken: new Set() });
    const { page, session } = studio;
    this.command = make('code', { tabIndex: 0, 'aria-label': 'The same picture from the command line' });
    const copy = make('button', { type: 'button', className: 'small', textContent: 'Copy' });
    copy.addEventListener('click', async () => {
      if (await copyText(this.command.textContent)) return page.toast('Command copied');
      getSelection().selectAllChildren(this.command);
      page.toast('Press Ctrl-C to copy');
    });
    this.name = make('input', { type: 'text', autocomplete: 'off', spellcheck: false, 'aria-label': 'File name of the picture' });
    this.name.addEventListener('input', () => (this.named = this.name.value.trim() !== ''));
    this.quality = make('select', { 'aria-label': 'Quality' }, ...QUALITIES.map((value) => make('option', { value, textContent: value })));
    this.quality.value = 'preview';
    this.layout = make('select', { 'aria-label': 'Layout of the eyes' }, ...this.layouts());
    this.layout.addEventListener('change', () => session.edit({ 'sidecar.picture.layout': this.layout.value }));
    this.width = make('input', { type: 'text', inputMode: 'numeric', 'aria-label': 'Width of one eye in pixels' });
    this.width.addEventListener('change', () => session.edit({ width: Math.round(Number(this.width.value)) || session.settings.width }));
    this.go = make('button', { type: 'button', className: 'primary', textContent: 'Render' });
    this.go.addEventListener('click', () => this.attempt(() => this.render()));
    const save = make('button', { type: 'button', textContent: 'Save camera' });
    save.addEventListener('click', () => this.attempt(async () => {
      await session.settle();
      page.toast(`Camera saved: ${(await ask('save', {})).file}`);
      session.send(true); // the command names the files that were saved
    }));
    this.bar = make('progress', { max: 1, value: 0, 'aria-label': 'Rendering' });
    this.text = make('output', {});
    this.cancel = make('button', { type: 'button', className: 'small', textContent: 'Cancel' });
    this.cancel.addEventListener('click', () => this.attempt(() => ask('cancel', {})));
    this.show = make('button', { type: 'button', className: 'small primary', textContent: 'Show' });
    this.show.addEventListener('click', () => this.attempt(() => studio.showItem(this.item)));
    this.job = make('div', { className: 'job', hidden: true }, this.bar, this.text, this.cancel, this.show);
    this.what = make('span', { className: 'what' });
    const form = make('form', {},
      make('div', { className: 'out' }, this.name, this.quality),
      make('div', { className: 'out' }, this.layout, this.width, make('span', { className: 'unit', textContent: 'px per eye' })),
      make('div', { className: 'out' }, save));
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.attempt(() => this.render());
    });
    this.note = make('p', { className: 'note', hidden: true });
    const more = make('div', { className: 'more', id: 'render-more', hidden: true }, make('div', { className: 'command' }, this.command, copy), this.note, form);
    const open = make('button', { type: 'button', className: 'small unfold', 'aria-controls': more.id, 'aria-expanded': 'false', 'aria-label': 'File, size, command', 'data-tip': 'File, size, command' }, icon('down'));
    open.addEventListener('click', () => {
      more.hidden = !more.hidden;
      open.ariaExpanded = String(!more.hidden);
    });
    element.append(more, make('div', { className: 'line' }, this.go, this.what, this.job, open));
    session.addEventListener('accepted', ({ detail }) => {
      if (detail === session.side) this.named ? this.tell() : this.suggest();
    });
    for (const field of [this.name, this.quality]) field.addEventListener('input', () => this.tell());
    session.addEventListener('edit', () => this.update());
    session.addEventListener('found', () => {
      if (studio.panel.said.textContent === ENDED) studio.panel.complain('');
    });
    this.update();
    this.watch();
  }

  layouts() {
    return LAYOUTS.filter(({ name }) => name !== 'mono').map(({ name }) => make('option', { value: name, textContent: name }));
  }

  update() {
    const { settings } = this.studio.session;
    const { layout } = settings.sidecar.picture;
    if (![...this.layout.options].some(({ value }) => value === layout)) this.layout.append(make('option', { value: layout, textContent: layout }));
    this.layout.value = layout;
    if (document.activeElement !== this.width) this.width.value = settings.width;
    if (!this.named) this.suggest();
  }

  // The first unused name, among the known files.
  suggest() {
    let count = 1;
    while (this.taken.has(this.studio.fileName(count))) count++;
    this.name.value = this.studio.fileName(count);
    this.tell();
  }

  // Shows the server's command, with the name and the quality from here. Lines break between options only.
  tell() {
    const { command, note } = this.studio.session.side;
    if (!command) return;
    if (!this.watching) [this.what.hidden, this.job.hidden] = [false, true];
    Object.assign(this.note, { textContent: note ?? '', hidden: !note });
    const name = this.name.value.trim();
    this.what.textContent = name;
    const quoted = /^[\w.,/:=+%@-]+$/.test(name) ? name : `'${name.replaceAll("'", "'\\''")}'`;
    const whole = command.replace(/ -o .*$/, ` --quality ${this.quality.value} -o ${quoted}`);
    this.command.replaceChildren(...whole.split(/ (?=-)/).flatMap((part, i) => [i ? ' ' : '', make('span', { textContent: part })]));
  }

  async attempt(run) {
    const { panel } = this.studio;
    panel.complain('');
    try {
      await run();
    } catch (error) {
      panel.complain(error.message);
    }
  }

  say(text, state) {
    Object.assign(this.job, { hidden: false, className: `job ${state}` });
    this.what.hidden = true;
    this.text.textContent = text;
    this.bar.hidden = this.cancel.hidden = state !== 'running';
    this.show.hidden = state !== 'done' || this.item === undefined;
  }

  async render() {
    if (this.watching) return;
    await this.studio.session.settle();
    const output = this.name.value.trim();
    await ask('render', { output, quality: this.quality.value }).catch((error) => {
      if (/exists/.test(error.message)) this.take(output);
      throw error;
    });
    this.bar.value = 0;
    this.say('Starting', 'running');
    this.watch();
  }

  take(name) {
    this.taken.add(name);
    if (!this.named) return this.suggest();
    if (name !== this.name.value.trim()) return;
    // The suffix that players understand is kept at the end.
    const known = this.studio.session.side.end;
    const end = known && name.endsWith(known) ? known : /\.\w+$/.exec(name)?.[0] ?? '';
    const stem = name.slice(0, name.length - end.length);
    let count = 2;
    while (this.taken.has(`${stem}-${count}${end}`)) count++;
    this.name.value = `${stem}-${count}${end}`;
    this.tell();
  }

  // Follows a running job, also after a reload of the page.
  async watch() {
    if (this.watching) return;
    this.watching = true;
    let began = false;
    for (;;) {
      const job = await ask('job').catch(() => null);
      if (!job || job.state === 'none') break;
      if (job.state === 'running') {
        began = true;
        this.go.disabled = true;
        this.bar.value = job.done;
        this.say(job.left > 0 ? `${Math.floor(100 * job.done)} %, ${timeOf(job.left)} left` : 'Starting', 'running');
        await sleep(POLL);
        continue;
      }
      if (began || this.job.classList.contains('running')) this.ended(job);
      break;
    }
    Object.assign(this, { watching: false });
    this.go.disabled = false;
  }

  ended({ state, text, item, output }) {
    this.item = item;
    if (state === 'done') this.take(output);
    this.say(state === 'done' ? output : state === 'cancelled' ? 'Cancelled: nothing is kept' : 'It failed', state);
    if (state === 'failed') this.studio.panel.complain(text || 'ods render has failed');
  }
}
