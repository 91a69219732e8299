// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The browser's own control for a file with Apple's tags (`system` of view.json): Safari of visionOS wraps a tagged
// video around the viewer from <video controls>, and opens a spatial photo from <img controls>.
import { make } from './elements.js';
import { icon } from './icons.js';
import { t } from './translate.js';

export function showSystemPlayer({ element, viewer }) {
  const { about, picture, base } = viewer;
  const src = new URL(about.system, base).href;
  const own = picture?.video;
  own?.pause();
  const shown = own ? make('video', { src, playsInline: true, currentTime: own.currentTime }) : make('img', { src, alt: about.name });
  shown.toggleAttribute('controls', true); // not all browsers have such a property of pictures
  const close = make('button', { type: 'button', ariaLabel: t('Close') }, icon('close'));
  Object.assign(shown.style, { width: '100%', height: '100%', objectFit: 'contain' });
  Object.assign(close.style, { position: 'absolute', right: '12px', top: '12px', background: 'var(--glass)' });
  const box = make('div', { id: 'system' }, shown, close);
  Object.assign(box.style, { position: 'absolute', inset: 0, background: '#000' });
  const end = () => {
    if (own && viewer.picture?.video === own) own.currentTime = shown.currentTime;
    shown.removeAttribute('src'); // stops it
    box.remove();
    viewer.removeEventListener('open', end);
    viewer.element.focus({ preventScroll: true });
  };
  close.addEventListener('click', end);
  box.addEventListener('keydown', (event) => {
    event.stopPropagation();
    if (event.key === 'Escape') end();
  });
  viewer.addEventListener('open', end);
  element.append(box);
  close.focus();
}
