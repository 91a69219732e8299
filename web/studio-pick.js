// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A click on the picture shows data of its point: its distance, its disparity and its position in each eye's picture.
import { clamp } from './geometry.js';
import { icon } from './icons.js';
import { directionAt, partsOf, placeOf } from './places.js';
import { make } from './elements.js';
import { ask } from './studio-session.js';

const NEAR = 5; // maximum movement of a click, pixels
const LONG = 500; // maximum duration of a click, milliseconds
const AWAY = 16; // pixels between the card and its point
const EDGE = 8;
const BAR = 64; // pixels covered by the bar below

const distance = (metres) => (metres < 1 ? `${(metres * 100).toFixed(1)} cm` : `${metres.toFixed(metres < 100 ? 2 : 0)} m`);

// Puts the camera above a point, and closes the card if nothing else has been picked meanwhile.
async function standOn({ walk }, point, direction, isPicked, say, hide) {
  const fault = await walk.stand({ point, direction }).catch((error) => error.message);
  if (!isPicked(direction)) return;
  if (fault) say(fault);
  else hide();
}

// Returns a function that picks the middle.
export function pickWithClicks(studio) {
  const { viewer } = studio.page;
  const { element } = viewer;
  const mark = make('div', { id: 'pick-mark', hidden: true });
  const card = make('div', { id: 'pick', role: 'status', hidden: true });
  document.body.append(mark, card);
  let where = null;
  let down = null;
  const hide = () => {
    where = null;
    mark.hidden = card.hidden = true;
  };
  const follow = () => {
    const place = where && viewer.scene ? placeOf(viewer, where, partsOf(viewer)[0]) : null;
    mark.hidden = card.hidden = !place;
    if (!place) return;
    const put = (element, x, y) => Object.assign(element.style, { left: `${x}px`, top: `${y}px` });
    put(mark, ...place);
    // Beside the point, on the side with enough space, and never beyond the picture's edge.
    const [wide, high] = [card.offsetWidth, card.offsetHeight];
    const beside = (at, size, whole) => clamp(at + size + AWAY > whole ? at - size - AWAY : at + AWAY, EDGE, Math.max(whole - size - EDGE, EDGE));
    put(card, beside(place[0], wide, element.clientWidth), beside(place[1], high, element.clientHeight - BAR));
  };
  const row = (name, value) => make('div', {}, make('dt', { textContent: name }), make('dd', { textContent: value }));
  const button = (text, run) => {
    const element = make('button', { type: 'button', className: 'small', textContent: text });
    element.addEventListener('click', run);
    return element;
  };
  const close = make('button', { type: 'button', className: 'small close', 'aria-label': 'Close', 'data-tip': 'Close', 'data-key': 'Esc' }, icon('close'));
  close.addEventListener('click', hide);
  const say = (textContent) => card.replaceChildren(make('p', { textContent }), close);
  const stand = (point) => standOn(studio, point, where, (direction) => where === direction, say, hide).then(follow);
  const tell = (found) => {
    if (found.nothing) return say('Nothing is there: the sky.');
    const pixel = (place) => (place ? `${place.map((value) => value.toFixed(1)).join(', ')} px` : 'not seen');
    const metres = Number(found.distance.toPrecision(4));
    const { comfort } = found;
    card.replaceChildren(
      make('dl', {}, row('Distance', distance(found.distance)), row('Disparity', `${found.disparity.toFixed(1)}′`),
        ...(comfort ? [row('Comfort', comfort.level), row('Height, at worst', `${comfort.vertical.toFixed(1)}′`)] : []),
        row('Left eye', pixel(found.left)), row('Right eye', pixel(found.right)), row('Point', found.point.map((value) => (Math.round(100 * value) / 100 + 0).toFixed(2)).join(', '))),
      make('div', { className: 'row' },
        ...(found.point[1] < studio.session.settings.sidecar.position[1] ? [button('Stand here', () => stand(found.point))] : []),
        button('Converge here', () => {
          const { mode } = studio.session.settings.sidecar.convergence;
          studio.session.edit({ 'sidecar.convergence.distance': metres, ...(mode === 'parallel' && { 'sidecar.convergence.mode': 'toe-in' }) });
        }),
        button('Focus here', () => studio.session.edit({ 'sidecar.lens.focus_distance': metres }))),
      close);
  };
  const pick = async (x, y) => {
    const direction = directionAt(viewer, x, y);
    if (!direction) return;
    where = direction;
    say('…');
    follow();
    try {
      await studio.session.settle();
      const found = await ask('pick', direction);
      if (where === direction) tell(found);
    } catch (error) {
      if (where === direction) say(error.message);
    }
    follow();
  };
  element.addEventListener('pointerdown', (event) => {
    down = event.isPrimary && !event.button ? { x: event.clientX, y: event.clientY, at: performance.now() } : null;
  });
  element.addEventListener('pointerup', (event) => {
    const from = down;
    down = null;
    if (!from || !viewer.scene || Math.hypot(event.clientX - from.x, event.clientY - from.y) > NEAR || performance.now() - from.at > LONG) return;
    if (where) hide();
    else pick(event.offsetX, event.offsetY);
  });
  addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !where) return;
    if (card.contains(document.activeElement)) element.focus();
    hide();
  });
  viewer.addEventListener('change', follow);
  viewer.addEventListener('open', follow);
  studio.session.addEventListener('edit', follow);
  // By keyboard: picks the middle of the view (of the left one) and focuses the card's buttons.
  return async () => {
    if (where) return hide();
    const { box: [left, top, width, height] } = partsOf(viewer)[0];
    await pick(left + width / 2, top + height / 2);
    card.querySelector('button')?.focus();
  };
}
