// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The page's state in its address, so that a link shows exactly what its sender saw:
//   #item=0&yaw=30&pitch=-20&fov=90&mode=left&swap=1&grid=1&layout=..&projection=..&exposure=..&tone=..&frame=12&layers=1
// eye=left and eye=right are other words for mode=.
const NUMBERS = ['yaw', 'pitch', 'fov'];
const CHOICES = ['layout', 'projection', 'tone'];

export function readState(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  const number = (name) => {
    const value = words.get(name);
    return value !== null && value !== '' && Number.isFinite(Number(value)) ? Number(value) : undefined;
  };
  const look = {};
  for (const name of NUMBERS) if (number(name) !== undefined) look[name] = number(name);
  for (const name of ['swap', 'grid']) if (words.has(name)) look[name] = words.get(name) !== '0';
  const mode = words.get('mode') ?? words.get('eye');
  if (mode) look.mode = mode;
  const choice = {};
  for (const name of CHOICES) if (words.get(name)) choice[name] = words.get(name);
  if (number('exposure') !== undefined) choice.exposure = number('exposure');
  const whole = (name) => Math.max(0, Math.floor(number(name) ?? 0));
  return { item: whole('item'), frame: whole('frame'), layers: words.has('layers'), look, choice };
}

export function writeState({ item, frame, layers, look, choice }) {
  const words = [`item=${item}`];
  for (const name of NUMBERS) words.push(`${name}=${Math.round(look[name] * 100) / 100}`);
  words.push(`mode=${look.mode}`);
  for (const name of ['swap', 'grid']) if (look[name]) words.push(`${name}=1`);
  for (const name of [...CHOICES, 'exposure']) {
    if (choice[name] !== undefined) words.push(`${name}=${encodeURIComponent(choice[name])}`);
  }
  if (frame) words.push(`frame=${frame}`);
  if (layers) words.push('layers=1');
  return `#${words.join('&')}`;
}
