// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tooltips: data-tip describes a control, data-key is its key. One tooltip for the whole root, above everything, so
// that it is never clipped. It appears when a mouse rests or the keyboard focus arrives, and disappears with Escape.
import { clamp } from './geometry.js';

const REST = 500; // milliseconds
const GAP = 8; // pixels

export function watchTips(root) {
  const tip = document.createElement('div');
  Object.assign(tip, { id: 'tip', popover: 'manual', ariaHidden: true }); // the control has the same name
  (root.body ?? root).append(tip);
  let owner = null;
  let timer;
  const hide = () => {
    clearTimeout(timer);
    owner = null;
    if (tip.matches(':popover-open')) tip.hidePopover();
  };
  const show = () => {
    if (!owner?.isConnected || !owner.dataset.tip) return;
    tip.textContent = owner.dataset.tip;
    if (owner.dataset.key) tip.append(Object.assign(document.createElement('kbd'), { textContent: owner.dataset.key }));
    tip.showPopover();
    const of = owner.getBoundingClientRect();
    const [width, height] = [tip.offsetWidth, tip.offsetHeight];
    const left = clamp(of.left + (of.width - width) / 2, GAP, innerWidth - width - GAP);
    const above = of.top - height - GAP;
    Object.assign(tip.style, { left: `${left}px`, top: `${above > GAP ? above : of.bottom + GAP}px` });
  };
  const begin = (target, rest) => {
    const next = target.closest?.('[data-tip]');
    if (next === owner) return;
    hide();
    owner = next;
    if (owner) timer = setTimeout(show, rest);
  };
  root.addEventListener('pointerover', (event) => event.pointerType === 'mouse' && begin(event.target, REST));
  root.addEventListener('focusin', ({ target }) => target.matches(':focus-visible') && begin(target, 0));
  for (const event of ['pointerdown', 'focusout', 'pointerout']) root.addEventListener(event, hide);
  root.addEventListener('keydown', hide, true);
}
