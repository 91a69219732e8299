// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The panel of real-time objects, for those who place them: which one is chosen, where it is, and the command that
// renders the same. Visitors of a site do not see it.
import { make } from './elements.js';

const TURN = 15; // degrees of a button
const BOX = {
  position: 'absolute', left: '12px', top: 'var(--below)', maxWidth: 'min(340px, calc(100% - 24px))', padding: '8px 10px', borderRadius: '12px',
  background: 'var(--glass)', border: '1px solid var(--edge)', display: 'grid', gap: '4px',
};
const CODE = { display: 'block', overflowWrap: 'anywhere', userSelect: 'all', fontSize: '12px', padding: '6px 0' };

const shown = (value) => String(value).replace('-', '−');

export class ObjectsPanel {
  constructor(objects) {
    this.objects = objects;
    const { viewer } = objects;
    const button = (text, run) => {
      const each = make('button', { type: 'button', textContent: text });
      each.addEventListener('click', () => run());
      return each;
    };
    this.which = make('select', { 'aria-label': 'Object' });
    this.which.addEventListener('change', () => objects.choose(objects.all[this.which.value] ?? null));
    this.place = make('output', { 'aria-label': 'Place of the object' });
    this.tools = make('div', { className: 'row' }, button('Turn left', () => objects.turnBy(TURN)), button('Turn right', () => objects.turnBy(-TURN)));
    this.back = button('Undo', () => objects.undo());
    this.show = button('Command', () => this.toggle());
    this.show.setAttribute('aria-expanded', 'false');
    this.code = make('code', { tabIndex: 0, 'aria-label': 'The command that renders this' });
    this.said = make('span', { role: 'status' });
    this.more = make('div', { hidden: true }, this.code, make('div', { className: 'row' }, button('Copy', () => this.copy())), this.said);
    this.fault = make('p', { role: 'alert', hidden: true });
    this.element = make('section', { id: 'objects', 'aria-label': 'Objects' }, this.which, this.place, this.tools,
      make('div', { className: 'row' }, this.back, this.show), this.more, this.fault);
    Object.assign(this.element.style, BOX);
    Object.assign(this.code.style, CODE);
    this.place.style.color = 'var(--soft)';
    this.fault.style.margin = 0;
    if (viewer.view.live) viewer.element.after(this.element);
    this.update();
  }

  // Names, place and command of what is chosen.
  update() {
    const { objects: { all, chosen, past }, which, place, tools, back, element, fault } = this;
    const names = ['', ...all.map(({ info: { name } }) => name)];
    if (which.options.length !== names.length) {
      which.replaceChildren(...names.map((name, i) => make('option', { value: i - 1 }, name || 'Choose an object, or drag one')));
    }
    which.value = all.indexOf(chosen);
    which.hidden = back.hidden = this.show.hidden = all.length === 0;
    back.disabled = past.length === 0;
    place.hidden = tools.hidden = !chosen;
    if (chosen) place.textContent = `${chosen.at.map(shown).join(', ')} m, ${shown(chosen.turn)}°`;
    if (!this.more.hidden) this.tell();
    element.hidden = all.length === 0 && fault.hidden;
  }

  toggle() {
    this.more.hidden = !this.more.hidden;
    this.show.setAttribute('aria-expanded', String(!this.more.hidden));
    this.said.textContent = '';
    this.update();
  }

  // Lines break between options only.
  tell() {
    this.code.replaceChildren(...this.objects.command().flatMap((part, i) => {
      const span = make('span', { textContent: part });
      span.style.display = 'inline-block';
      return [i ? ' ' : '', span];
    }));
  }

  async copy() {
    const { copyText } = await import('./copy.js');
    const is = await copyText(this.code.textContent);
    if (!is) getSelection().selectAllChildren(this.code);
    this.said.textContent = is ? 'Command copied' : 'Press Ctrl-C to copy';
  }

  // A line of text that stays until the next one; empty: none.
  complain(words) {
    Object.assign(this.fault, { textContent: words, hidden: !words });
    this.update();
  }

  free() {
    this.element.remove();
  }
}
