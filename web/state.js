// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The page's state in its address, so that a link shows exactly its sender's view:
//   #item=0&name=harbour.jpg&yaw=30&pitch=-20&fov=90&shift=0.5&x=0.05&y=0.01&z=-0.1&mode=left&swap=1&grid=1&planet=1
//    &layout=..&projection=..&exposure=..&tone=..&frame=12&layers=1&controls=all
// eye=left and eye=right are aliases of mode=. A picture compared with it: beside=1&beside-name=..&beside-layout=..
// Names count, because numbers change when a file joins the folder.
const NUMBERS = ['yaw', 'pitch', 'fov', 'shift', 'x', 'y', 'z'];
const SWITCHES = ['swap', 'grid', 'planet'];
const CHOICES = ['layout', 'projection', 'tone', 'exposure'];

export function readState(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  const number = (name) => {
    const value = words.get(name);
    return value !== null && value !== '' && Number.isFinite(Number(value)) ? Number(value) : undefined;
  };
  const look = {};
  for (const name of NUMBERS) if (number(name) !== undefined) look[name] = number(name);
  for (const name of SWITCHES) if (words.has(name)) look[name] = words.get(name) !== '0';
  const mode = words.get('mode') ?? words.get('eye');
  if (mode) look.mode = mode;
  const choiceOf = (before) => {
    const choice = {};
    for (const name of CHOICES) if (words.get(before + name)) choice[name] = name === 'exposure' ? number(before + name) : words.get(before + name);
    return choice;
  };
  const whole = (name) => Math.max(0, Math.floor(number(name) ?? 0));
  const beside = words.has('beside') ? { item: whole('beside'), name: words.get('beside-name') ?? '', choice: choiceOf('beside-') } : null;
  return { item: whole('item'), name: words.get('name') ?? '', frame: whole('frame'), layers: words.has('layers'), controls: words.get('controls') === 'all', look, choice: choiceOf(''), beside };
}

// Returns the index of the item that an address names, or of its number if the name is unknown.
export function findItem(items, { item, name }) {
  const number = Math.min(item, items.length - 1);
  if (!name || items[number]?.name === name) return number;
  const found = items.findIndex((each) => each.name === name);
  return found < 0 ? number : found;
}

export function writeState({ item, name, frame, layers, controls, look, choice, beside }) {
  const words = [`item=${item}`];
  if (name) words.push(`name=${encodeURIComponent(name)}`);
  NUMBERS.forEach((name, i) => (look[name] || i < 3) && words.push(`${name}=${Math.round(look[name] * 1000) / 1000}`));
  words.push(`mode=${look.mode}`);
  for (const name of SWITCHES) if (look[name]) words.push(`${name}=1`);
  const tell = (chosen, before) => {
    for (const name of CHOICES) if (chosen[name] !== undefined) words.push(`${before}${name}=${encodeURIComponent(chosen[name])}`);
  };
  tell(choice, '');
  if (beside) {
    words.push(`beside=${beside.item}`);
    if (beside.name) words.push(`beside-name=${encodeURIComponent(beside.name)}`);
    tell(beside.choice, 'beside-');
  }
  if (frame) words.push(`frame=${frame}`);
  if (layers) words.push('layers=1');
  if (controls) words.push('controls=all');
  return `#${words.join('&')}`;
}
