// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The compass of a tour, and its plan: an image of the floor with the places of the panoramas, of which the present one
// has a cone for the view. A click on a place goes there.
import { make } from './elements.js';
import { angleAcross } from './panorama.js';
import { t } from './translate.js';

const ROOMY = [800, 560]; // pixels: a plan would cover a smaller picture, so it waits for a click
const BESIDE = 280; // pixels: what is above the plan, and below it

const drawing = (tag, attributes, ...children) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};

function makeCompass(guide) {
  const north = [drawing('path', { d: 'M22 2l5 10H17z' }), drawing('path', { d: 'M22 41v-4M41 22h-4M3 22h4', class: 'line' })];
  const letter = drawing('text', { x: 22, y: 27, 'text-anchor': 'middle' }, 'N');
  const dial = drawing('g', {}, ...north, letter);
  const button = make('button', { id: 'compass', type: 'button' }, drawing('svg', { viewBox: '0 0 44 44', 'aria-hidden': 'true' }, dial));
  button.addEventListener('click', () => guide.north());
  const show = () => {
    const { heading } = guide;
    button.hidden = heading === null;
    if (heading === null) return;
    dial.setAttribute('transform', `rotate(${-heading.toFixed(1)} 22 22)`);
    letter.setAttribute('transform', `rotate(${heading.toFixed(1)} 22 22)`);
    button.dataset.tip = button.ariaLabel = t('Compass: {}°. Look north', Math.round(heading) % 360);
  };
  return [button, show];
}

function makePlan(player, guide) {
  const { viewer } = player;
  const { plan } = guide.tour;
  const image = make('img', { src: new URL(plan.image, viewer.base).href, alt: '', draggable: false });
  const cone = make('div', { className: 'cone' });
  const map = make('div', { className: 'map' }, image, cone);
  const box = make('div', { id: 'plan', role: 'group', ariaLabel: t('Plan'), hidden: player.element.clientWidth < ROOMY[0] || player.element.clientHeight < ROOMY[1] }, map);
  const toggle = make('button', { id: 'plan-toggle', type: 'button', textContent: t('Plan') });
  toggle.addEventListener('click', () => {
    box.hidden = !box.hidden;
    toggle.ariaExpanded = String(!box.hidden);
  });
  toggle.ariaExpanded = String(!box.hidden);
  const dots = guide.dots.map((at, i) => {
    if (!at) return null;
    const title = guide.titleOf(i);
    const dot = make('button', { type: 'button', className: 'dot', ariaLabel: t('Go to {}', title) });
    dot.dataset.tip = title;
    dot.addEventListener('click', () => guide.go(i));
    return Object.assign(dot, { at });
  });
  map.append(...dots.filter(Boolean));
  const put = (element, [x, y]) => Object.assign(element.style, { left: `${(100 * x) / image.naturalWidth}%`, top: `${(100 * y) / image.naturalHeight}%` });
  image.addEventListener('load', () => {
    for (const dot of dots) if (dot) put(dot, dot.at);
    show();
  });
  image.addEventListener('error', () => (toggle.hidden = box.hidden = true));
  const show = () => {
    dots.forEach((dot, i) => dot?.setAttribute('aria-current', String(i === guide.item)));
    const here = dots[guide.item];
    cone.hidden = !here || !image.naturalWidth;
    if (cone.hidden) return;
    put(cone, here.at);
    const { clientWidth: width, clientHeight: height } = viewer.element;
    image.style.maxHeight = `${Math.min(Math.max(height - BESIDE, 90), 240)}px`;
    const wide = Math.min(angleAcross(viewer.state, width / height), 180);
    cone.style.setProperty('--wide', `${wide.toFixed(0)}deg`);
    cone.style.rotate = `${((guide.heading ?? 0) - (plan.heading ?? 0)).toFixed(1)}deg`;
  };
  return [toggle, box, show];
}

export function showPlan(player, guide) {
  const { viewer } = player;
  const [compass, turn] = makeCompass(guide);
  const [toggle, box, show] = guide.tour.plan ? makePlan(player, guide) : [];
  const tools = make('div', { id: 'guide' }, ...[compass, toggle].filter(Boolean));
  player.element.append(tools, ...(box ? [box] : []));
  const update = () => {
    turn();
    show?.();
  };
  for (const event of ['change', 'open']) viewer.addEventListener(event, update);
  guide.addEventListener('spots', update);
  update();
}
