// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The caption and the spots of a picture over it at the desk: each spot is a button, in both eyes' pictures if both are
// shown. A spot with a text opens a card, a way of a tour leads on. Ways out of view are named above the bar, on the side
// to which one turns. All is text, never HTML. The spots come from the guide (tour.js).
import { make } from './elements.js';
import { clamp, wrapDegrees } from './geometry.js';
import { modeOf } from './modes.js';
import { partsOf, placeOf } from './places.js';
import { t } from './translate.js';
import { RING, seenBy } from './tour-ways.js';

const TURN = 400; // milliseconds
const ROOMY = 260; // pixels: a lower view has no room for names above the bar

// Turns the view, until the visitor does; at once for those who want less motion.
function lookAt(viewer, { yaw, pitch }) {
  if (matchMedia('(prefers-reduced-motion: reduce)').matches) return viewer.set({ yaw, pitch });
  const [from, begun] = [{ ...viewer.state }, performance.now()];
  let last = from.yaw;
  const step = (now) => {
    if (viewer.state.yaw !== last) return;
    const part = clamp((now - begun) / TURN, 0, 1);
    const eased = part * part * (3 - 2 * part);
    viewer.set({ yaw: from.yaw + eased * wrapDegrees(yaw - from.yaw), pitch: from.pitch + eased * (pitch - from.pitch) });
    last = viewer.state.yaw;
    if (part < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

// The names of ways out of view, above the bar in `foot`.
function waysAside(viewer, foot) {
  const sides = [0, 1].map(() => make('div', {})); // left, right
  foot.prepend(make('div', { id: 'aside', ariaHidden: 'true' }, ...sides)); // the Tab key reaches the signs themselves
  return {
    clear: () => sides.forEach((side) => side.replaceChildren()),
    make({ title, at }) {
      const name = make('button', { type: 'button', tabIndex: -1 }, make('span', { textContent: title }));
      name.addEventListener('click', () => lookAt(viewer, seenBy(0, at)));
      return name;
    },
    place(name, { at }, isHidden) {
      name.hidden = isHidden || viewer.element.clientHeight < ROOMY;
      if (name.hidden) return;
      const side = sides[Number(wrapDegrees(seenBy(0, at).yaw - viewer.state.yaw) >= 0)];
      if (name.parentElement !== side) side.append(name);
    },
  };
}

// The parts of the view, each with the eye for which it is: 1 left, -1 right. Where both share it, there are two parts.
function seenParts(viewer) {
  const { state } = viewer;
  const parts = partsOf(viewer);
  const both = parts.length === 1 && modeOf(state.mode).parts(0)[0].show === 'anaglyph';
  if (both) return [{ ...parts[0], side: 1, tint: 'red' }, { ...parts[0], side: -1, tint: 'cyan' }];
  return parts.map((part) => ({ ...part, side: parts.length < 2 ? 0 : (part.eye ^ Number(state.swap)) ? -1 : 1 }));
}

export function showNotes(viewer, guide) {
  const caption = make('p', { id: 'caption' });
  const layer = make('div', { id: 'spots' });
  const card = make('div', { id: 'card', role: 'status', hidden: true });
  viewer.element.after(layer, caption, card);
  const aside = waysAside(viewer, layer.parentElement.querySelector('#foot'));
  let entries = []; // { spot, buttons, rings }: one for each part of the view

  const makeButton = (spot, k) => {
    const label = spot.to === undefined ? spot.title : t('Go to {}', spot.title);
    const button = make('button', { type: 'button', className: spot.to === undefined ? 'spot' : 'spot way', ariaLabel: label, hidden: k > 0 },
      make('i'), make('span', { textContent: spot.to === undefined ? spot.number : spot.title }));
    if (spot.to === undefined) Object.assign(button.dataset, { tip: spot.title });
    if (k) Object.assign(button, { tabIndex: -1, ariaHidden: 'true' });
    button.addEventListener('click', () => spot.run());
    button.addEventListener('focus', () => button.classList.contains('away') && viewer.set(seenBy(0, spot.at)));
    return button;
  };
  const fill = () => {
    const { about } = viewer;
    caption.textContent = about?.caption ?? '';
    caption.hidden = !caption.textContent;
    const { activeElement } = layer.getRootNode();
    const hadFocus = layer.contains(activeElement);
    entries = guide.spots.map((spot) => ({
      spot, buttons: [0, 1].map((k) => makeButton(spot, k)),
      name: spot.to !== undefined && aside.make(spot), rings: spot.foot ? [0, 1].map(() => make('div', { className: 'ring', hidden: true })) : [],
    }));
    aside.clear();
    layer.replaceChildren(...entries.flatMap(({ rings, buttons }) => [...rings, ...buttons]));
    place();
    if (hadFocus) viewer.element.focus({ preventScroll: true });
  };
  const find = (point, part) => {
    const { state, picture } = viewer;
    const seen = seenBy(part.side, point, picture?.mono ? { ipd: 0 } : picture?.camera);
    return placeOf(viewer, { ...seen, yaw: seen.yaw - (part.side * state.shift) / 2 }, part);
  };
  const placeRing = (ring, { foot }, part) => {
    const way = Math.hypot(foot[0], foot[2]) || 1;
    const ahead = [(RING * foot[0]) / way, 0, (RING * foot[2]) / way];
    const beside = [-ahead[2], 0, ahead[0]];
    const near = (axis, sign) => part && find(foot.map((x, i) => x + sign * axis[i]), part);
    const [left, right, low, high] = [near(beside, -1), near(beside, 1), near(ahead, -1), near(ahead, 1)];
    ring.hidden = !(left && right && low && high);
    if (ring.hidden) return;
    const [width, height] = [Math.hypot(right[0] - left[0], right[1] - left[1]), Math.hypot(high[0] - low[0], high[1] - low[1])];
    Object.assign(ring.style, { left: `${(left[0] + right[0] - width) / 2}px`, top: `${(low[1] + high[1] - height) / 2}px`, width: `${width}px`, height: `${height}px` });
    ring.className = `ring ${part.tint ?? ''}`;
  };
  const place = () => {
    const parts = viewer.session || !viewer.picture ? [] : seenParts(viewer);
    const whole = parts.length === 1 || parts[0]?.tint ? parts[0] : null; // the only part
    for (const entry of entries) {
      const { spot, buttons, rings } = entry;
      if (!entry.size?.[0]) entry.size = [buttons[0].offsetWidth, buttons[0].offsetHeight];
      if (entry.name) aside.place(entry.name, spot, !whole || Boolean(find(spot.at, whole)));
      rings.forEach((ring, i) => placeRing(ring, spot, parts[i]));
      buttons.forEach((button, i) => {
        const at = parts[i] && find(spot.at, parts[i]);
        button.hidden = i > 0 && !at;
        button.classList.toggle('away', !at);
        for (const tint of ['red', 'cyan']) button.classList.toggle(tint, parts[i]?.tint === tint);
        if (spot.to === undefined) button.ariaExpanded = String(spot === guide.open);
        if (at) Object.assign(button.style, { left: `${at[0] - entry.size[0] / 2}px`, top: `${at[1] - entry.size[1] / 2}px` });
      });
    }
    const { open } = guide;
    const at = open && parts[0] && find(open.at, parts[0]);
    card.hidden = !at;
    if (!at) return;
    card.replaceChildren(make('strong', { textContent: open.title }), make('p', { textContent: open.text ?? '' }));
    const left = clamp(at[0] - card.offsetWidth / 2, 8, viewer.element.clientWidth - card.offsetWidth - 8);
    const above = at[1] - card.offsetHeight - 26;
    card.style.translate = `${left}px ${above > 8 ? above : at[1] + 26}px`;
  };
  layer.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && guide.open) guide.tell(guide.open);
  });
  viewer.addEventListener('change', place);
  guide.addEventListener('spots', fill);
  guide.addEventListener('tell', place);
  new ResizeObserver(place).observe(viewer.element);
  fill();
}
