// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Controls of the studio's panel, each a row with its label, its value and a button back to the default. A number is
// typed, also with another unit (10 cm), dragged at its label, or moved with the arrow keys (Shift: finely, Ctrl:
// coarsely).
import { make } from './elements.js';
import { clamp } from './geometry.js';
import { icon } from './icons.js';

// Units that a user may write, in those of the rows.
const UNITS = {
  m: { km: 1000, m: 1, cm: 0.01, mm: 0.001, ft: 0.3048, in: 0.0254 },
  mm: { m: 1000, cm: 10, mm: 1, in: 25.4 },
  '°': { '°': 1, deg: 1, rad: 180 / Math.PI, '′': 1 / 60 },
  s: { min: 60, s: 1, ms: 0.001 },
  stops: { stops: 1, stop: 1, ev: 1 },
};

const pace = (event) => (event.shiftKey ? 0.1 : event.ctrlKey || event.metaKey ? 10 : 1);
let count = 0;

function row(spec, field, reset) {
  const id = `studio-${++count}`;
  field.id = id;
  const label = make('label', { for: id, textContent: spec.label });
  if (spec.about) label.dataset.tip = spec.about;
  const back = make('button', { type: 'button', className: 'reset', hidden: true }, icon('reset'));
  back.addEventListener('click', reset);
  return { label, back };
}

// The number, as short as the step allows: 65, 1.25.
export function textOf(value, step) {
  const digits = clamp(Math.ceil(-Math.log10(step) - 1e-9), 0, 6);
  const fine = Number(value.toFixed(digits)) === Number(value.toPrecision(7)) ? digits : digits + 2;
  return String(Number(value.toFixed(fine)));
}

// Returns the number in a text, converted to a unit of UNITS; NaN for any other text.
export function numberOf(text, unit) {
  const found = /^([-+]?[\d.]+(?:e[-+]?\d+)?)\s*(\S*)$/i.exec(text.trim().replace('−', '-').replace(',', '.'));
  const factor = found?.[2] ? UNITS[unit]?.[found[2].toLowerCase()] : 1;
  return found && factor ? Number(found[1]) * factor : NaN;
}

// spec: { label, name (of the row in messages, by default the label), unit, step, scale (shown = value * scale), and for the displayed number its range [low, high] for
// dragging and its limits for typing }.
// change(value, gesture, dragging), reset() and complain(text) are called; update(value, standard) shows a value.
export function numberRow(spec, change, reset, complain) {
  const { scale = 1, step, limits: [low, high] } = spec;
  const reach = [Math.max(low, spec.range[0]), Math.min(high, spec.range[1])];
  const field = make('input', { type: 'text', inputMode: 'decimal', autocomplete: 'off', spellcheck: false, role: 'spinbutton' });
  const { label, back } = row(spec, field, reset);
  const element = make('div', { className: 'row-of number' }, label, field, make('span', { className: 'unit', textContent: spec.unit ?? '' }), back);
  let shown = 0;
  const give = (value, gesture = null, dragging = false) => change(Number((clamp(value, low, high) / scale).toPrecision(9)), gesture, dragging);
  const read = () => {
    const text = field.value.trim();
    if (text === textOf(shown, step)) return;
    const value = numberOf(text, spec.unit);
    const name = spec.name ?? spec.label;
    const unit = spec.unit ? ` ${spec.unit}` : '';
    if (!Number.isFinite(value)) {
      field.value = textOf(shown, step);
      if (text) complain(`${name}: “${text}” is not a number${UNITS[spec.unit] ? ` of ${Object.keys(UNITS[spec.unit]).join(', ')}` : ''}`);
      return;
    }
    complain(value === clamp(value, low, high) ? '' : `${name} is between ${textOf(low, step)} and ${textOf(high, step)}${unit}`);
    give(value);
  };
  field.addEventListener('change', read);
  field.addEventListener('focus', () => field.select());
  let keys = null;
  let last = 0;
  field.addEventListener('keydown', (event) => {
    const by = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (event.key === 'Escape') field.value = textOf(shown, step);
    if (event.key === 'Enter') read();
    if (!by) return;
    event.preventDefault();
    if (performance.now() - last > 1000) keys = {};
    last = performance.now();
    give(shown + by * step * 5 * pace(event), keys);
  });
  let drag = null;
  label.addEventListener('pointerdown', (event) => {
    if (event.button) return;
    label.setPointerCapture(event.pointerId);
    drag = { x: event.clientX, value: shown, moved: false };
  });
  label.addEventListener('pointermove', (event) => {
    if (!drag) return;
    const by = event.clientX - drag.x;
    if (!drag.moved && Math.abs(by) < 3) return;
    drag.moved = true;
    drag.x = event.clientX;
    drag.value = clamp(drag.value + by * step * pace(event), ...reach);
    give(Math.round(drag.value / step) * step, drag, true);
  });
  const end = () => {
    if (drag?.moved) {
      give(Math.round(drag.value / step) * step, drag);
      label.addEventListener('click', (event) => event.preventDefault(), { once: true });
    }
    drag = null;
  };
  for (const name of ['pointerup', 'pointercancel']) label.addEventListener(name, end);
  label.addEventListener('dblclick', reset);
  return {
    element,
    update(value, standard) {
      shown = value * scale;
      if (document.activeElement !== field || field.value !== textOf(shown, step)) field.value = textOf(shown, step);
      for (const [name, of] of [['now', shown], ['min', low], ['max', high]]) field.setAttribute(`aria-value${name}`, Number(of.toFixed(6)));
      const text = textOf(standard * scale, step);
      back.hidden = field.value === text;
      back.dataset.tip = `Back to ${text}${spec.unit ? ` ${spec.unit}` : ''}`;
      back.setAttribute('aria-label', `${spec.label}: back to ${text}`);
    },
  };
}

// spec: { label, options: [[value, text], ...], names: of values that are not options }
export function choiceRow(spec, change, reset) {
  const field = make('select');
  const { label, back } = row(spec, field, reset);
  const element = make('div', { className: 'row-of choice' }, label, field, back);
  const fill = (options) => field.replaceChildren(...options.map(([value, text]) => make('option', { value, textContent: text })));
  fill(spec.options);
  field.addEventListener('change', () => change(field.value));
  label.addEventListener('dblclick', reset);
  return {
    element,
    update(value, standard) {
      if (![...field.options].some((option) => option.value === value)) fill([...spec.options, [value, spec.names[value] ?? value.split('/').pop()]]);
      field.value = value;
      back.hidden = value === standard;
      const text = [...field.options].find((option) => option.value === standard)?.textContent ?? standard;
      back.dataset.tip = `Back to ${text}`;
      back.setAttribute('aria-label', `${spec.label}: back to ${text}`);
    },
  };
}
