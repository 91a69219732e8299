// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The list of all items with their thumbnails, for choosing one. Loaded on first use. Returns functions that open and
// close it.
import { make } from './elements.js';
import { icon } from './icons.js';
import { itemName } from './item-name.js';

export function makeList({ element, viewer, nameOf }) {
  const list = make('div', { id: 'list', popover: 'auto', role: 'group', 'aria-label': 'All pictures' });
  element.append(list);
  const cell = (item, i) => {
    const { kind, thumbnail } = item;
    const name = nameOf(item) || itemName(item);
    const picture = make('img', { src: thumbnail ? new URL(thumbnail, viewer.base).href : '', alt: '', loading: 'lazy', decoding: 'async' });
    picture.addEventListener('error', () => picture.removeAttribute('src')); // an empty frame beats a broken image
    const button = make('button', { type: 'button', title: name, 'aria-current': String(i === viewer.item) }, picture, make('span', {}, name));
    if (kind === 'video') button.append(icon('play'));
    button.addEventListener('click', () => {
      list.hidePopover();
      viewer.open(i, viewer.lasting());
    });
    return button;
  };
  list.addEventListener('keydown', (event) => {
    const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!by) return;
    event.preventDefault(); // these keys must not turn the picture meanwhile
    const cells = [...list.children];
    cells[cells.indexOf(event.target.closest('button')) + by]?.focus();
  });
  return () => {
    if (list.matches(':popover-open')) return list.hidePopover();
    list.replaceChildren(...viewer.view.items.map(cell));
    list.showPopover();
    list.querySelector('[aria-current="true"]')?.focus();
  };
}
