// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// An author's notes on a picture: its caption, and hotspots, each a button in a direction, with a card of text. In
// view.json: { caption, hotspots: [{ yaw, pitch, title, text }] } (docs/view.md). They are text, never HTML.
import { make } from './elements.js';
import { clamp } from './geometry.js';
import { partsOf, placeOf } from './places.js';

export function showNotes(viewer) {
  const caption = make('p', { id: 'caption' });
  const layer = make('div', { id: 'spots' });
  const card = make('div', { id: 'card', role: 'status', hidden: true });
  viewer.element.after(layer, caption, card);
  let spots = []; // { spot, buttons: one for each part of the view }
  let open = null;

  const tell = (entry) => {
    open = entry === open ? null : entry;
    for (const { buttons, spot } of spots) buttons.forEach((button) => (button.ariaExpanded = String(spot === open?.spot)));
    card.hidden = !open;
    if (open) card.replaceChildren(make('strong', { textContent: open.spot.title }), make('p', { textContent: open.spot.text ?? '' }));
    place();
  };
  const fill = () => {
    const { about } = viewer;
    open = null;
    card.hidden = true;
    caption.textContent = about?.caption ?? '';
    caption.hidden = !caption.textContent;
    spots = (about?.hotspots ?? []).map((spot, i) => {
      const entry = { spot };
      entry.buttons = [0, 1].map(() => {
        const button = make('button', { type: 'button', className: 'spot', textContent: i + 1, ariaLabel: spot.title, ariaExpanded: 'false', hidden: true });
        button.dataset.tip = spot.title;
        button.addEventListener('click', () => tell(entry));
        return button;
      });
      return entry;
    });
    layer.replaceChildren(...spots.flatMap(({ buttons }) => buttons));
    place();
  };
  const place = () => {
    const parts = viewer.session ? [] : partsOf(viewer);
    for (const { spot, buttons } of spots) {
      buttons.forEach((button, i) => {
        const at = parts[i] && placeOf(viewer, spot, parts[i]);
        button.hidden = !at;
        if (at) button.style.translate = `${at[0]}px ${at[1]}px`;
      });
    }
    const at = open && parts[0] && placeOf(viewer, open.spot, parts[0]);
    card.hidden = !at;
    if (!at) return;
    const left = clamp(at[0] - card.offsetWidth / 2, 8, viewer.element.clientWidth - card.offsetWidth - 8);
    const above = at[1] - card.offsetHeight - 26;
    card.style.translate = `${left}px ${above > 8 ? above : at[1] + 26}px`;
  };
  layer.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && open) tell(open);
  });
  viewer.addEventListener('change', place);
  viewer.addEventListener('open', fill);
  new ResizeObserver(place).observe(viewer.element);
  fill();
}
