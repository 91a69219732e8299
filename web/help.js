// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The help: the keys of the actions, the functions of a headset's buttons, and the gestures. Loaded when it is first shown.
import { actionsOf, keysOf } from './actions.js';
import { titled } from './controls.js';
import { make } from './elements.js';
import { t } from './translate.js';

// The functions of a headset's buttons (headset.js).
const BUTTONS = [
  ['Look down', 'the menu’s handle: point at it and press, or look at it until its ring is full'],
  ['Hold the grip', 'the menu: files, seek bar, exposure, recentre and the rest; a press beside it closes it'],
  ['Trigger or pinch', 'play or pause; with a picture: next'],
  ['Hold trigger or pinch', 'recentre'],
  ['Stick left, right', 'back or ahead by 10 s; with a picture: previous, next'],
  ['Stick up, down', 'exposure, of HDR and EXR'],
  ['In the studio', 'stick left, right: where the merge starts; up, down: where it ends; trigger: settings A or B'],
  ['Press the stick', 'recentre'],
  ['Grip', 'next; of the left hand: previous'],
  ['A or X', 'swap the eyes'],
  ['B or Y', 'leave'],
];

const isTouch = () => matchMedia('(pointer: coarse)').matches;
const list = (pairs) => make('dl', {}, ...pairs.map(([what, ...does]) => make('div', {}, make('dt', {}, what), make('dd', {}, ...does))));
const section = (title, pairs, className = '') => make('section', { className }, make('h2', {}, title), list(pairs));
const rowOf = (action) => [titled(t(action.label)), ...keysOf(action).flatMap((text) => [make('kbd', {}, text), ' '])];

// The actions that apply now, with the most common ones first; none on touch devices, which have no keyboard.
function keysNow(player) {
  const { viewer } = player;
  if (isTouch()) return [];
  const rows = actionsOf(player).filter(({ label }) => label);
  const first = viewer.scene ? 'Studio' : viewer.picture?.video ? 'Video' : 'Look around';
  const groups = [...new Set(rows.map(({ group }) => group))].sort((a, b) => (b === first) - (a === first));
  return groups.map((group) => section(t(group), rows.filter((row) => row.group === group).map(rowOf)));
}

function buttonsOfHeadset({ scene }) {
  const rows = BUTTONS.filter(([what]) => Boolean(scene) || !/studio/.test(what));
  return section(t('In the headset'), rows.map((pair) => pair.map((text) => t(text))), 'words');
}

export function showHelp(player) {
  const help = player.find('help');
  player.find('keys').replaceChildren(...keysNow(player), ...(navigator.xr ? [buttonsOfHeadset(player.viewer)] : []));
  player.find('gestures').textContent = t(isTouch() ? 'Drag to look around, pinch to zoom' : 'Drag to look around; turn the wheel to zoom.');
  help.showModal();
  help.focus(); // not its button, whose tooltip would appear
}
