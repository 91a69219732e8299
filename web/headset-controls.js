// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The controls of the headset's panel, and their drawing. A control has its box in pixels, a text or an icon, and
// either run() or, for a slider, its position 0..1 and drag(part, isLast). It may paint(context, box, isHovered, ink) a
// picture of its own, `high` pixels high, which depends on `key`; and inside(box) gives controls that are in it.
import { clamp } from './geometry.js';
import { guideRows, isMapped, pointedAt } from './headset-guide.js';
import { itemName } from './item-name.js';
import { WORN } from './modes.js';
import { t } from './translate.js';

export const WIDE = 1024; // pixels
export const TEXT = 46; // pixels: line height
const PAD = 24;
const GAP = 12;
const HIGH = 84;
const LISTED = 3; // files at a time
const TURN = 30; // degrees
const STEPS = 400; // number of steps of a slider

const ICONS = {
  play: 'M8 5.5v13l10.5-6.5z', pause: 'M8 5.5h3v13H8zM14 5.5h3v13h-3z', previous: 'm14.5 6-6 6 6 6', next: 'm9.5 6 6 6-6 6',
  up: 'm6 14.5 6-6 6 6', down: 'm6 9.5 6 6 6-6', close: 'm7 7 10 10m0-10L7 17', menu: 'M4 7h16M4 12h16M4 17h16', less: 'M6 12h12', more: 'M6 12h12M12 6v12',
};
const SOLID = ['play', 'pause'];

const clock = (seconds) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, '0')}`;
const signed = (value) => (value > 0 ? '+' : value < 0 ? '−' : '') + Math.abs(value).toFixed(1);
const stepped = (part) => Math.round(clamp(part, 0, 1) * STEPS) / STEPS;

// Boxes for the cells of rows; a cell's width is its share of the row, by default 1.
function lay(rows) {
  let y = PAD;
  const controls = rows.flatMap((row) => {
    const whole = row.reduce((sum, { share = 1 }) => sum + share, 0);
    const width = WIDE - 2 * PAD - GAP * (row.length - 1);
    let x = PAD;
    const cells = row.map((cell) => {
      const control = { ...cell, box: [x, y, (width * (cell.share ?? 1)) / whole, cell.high ?? HIGH] };
      x += control.box[2] + GAP;
      return [control, ...(cell.inside?.(control.box) ?? [])];
    });
    y += (row[0].high ?? HIGH) + GAP;
    return cells.flat();
  });
  return { high: y - GAP + PAD, controls };
}

// Files, and in the studio its scene, which can be displayed.
function entriesOf({ viewer }) {
  const { studio } = viewer;
  const files = viewer.view.items.map((item, i) => ({ name: itemName(item), thumbnail: item.thumbnail, on: !viewer.scene && i === viewer.item, run: () => viewer.open(i, viewer.lasting()) }));
  return studio ? [{ name: studio.scene.name, on: Boolean(viewer.scene), run: () => studio.showScene() }, ...files] : files;
}

// The list of files, if there is more than one; panel.first is the first visible one.
function listRows(panel, entries) {
  if (entries.length < 2) return [];
  const last = Math.max(entries.length - LISTED, 0);
  panel.first = Math.min(panel.first, last);
  const by = (count) => () => (panel.first = clamp(panel.first + count, 0, last));
  const turns = [{ id: 'up', icon: 'up', run: by(-LISTED) }, { text: `${Math.ceil(panel.first / LISTED) + 1}/${Math.ceil(entries.length / LISTED)}` }, { id: 'down', icon: 'down', run: by(LISTED) }];
  return entries.slice(panel.first, panel.first + LISTED).map(({ name, thumbnail, on, run }, i) => {
    const row = [{ id: `item-${panel.first + i}`, text: name, image: panel.thumbnail(thumbnail), on, run, share: 9, isName: true }];
    return last ? [...row, turns[i]] : row;
  });
}

function videoRows({ picture, about, subtitles }) {
  if (!picture?.video) return [];
  const { video, fps, frames } = picture;
  const at = picture.frame();
  const hasSubtitles = subtitles && about.video?.subtitles;
  return [[
    { id: 'sound', text: t(video.muted ? 'Sound off' : 'Sound on'), on: !video.muted, run: () => (video.muted = !video.muted) },
    ...(hasSubtitles ? [{ id: 'subtitles', text: t(subtitles.isOn ? 'Subtitles on' : 'Subtitles off'), on: subtitles.isOn, run: () => subtitles.toggle() }] : []),
  ], [
    { id: 'play', icon: video.paused ? 'play' : 'pause', run: () => picture.toggle() },
    { id: 'seek', part: stepped(at / Math.max(frames - 1, 1)), share: 6, drag: (part, isLast) => (isLast || !video.seeking) && picture.seek((part * (frames - 1) + 0.5) / fps) },
    { text: clock(at / fps) + (Number.isFinite(frames) ? ` / ${clock(frames / fps)}` : ''), share: 3 },
  ]];
}

function exposureRow({ viewer }) {
  const steering = viewer.scene && viewer.steering;
  if (!steering && !viewer.about?.live) return [];
  const now = steering ? steering.exposure : (viewer.choice.exposure ?? viewer.about.exposure ?? 0);
  const by = (stops) => () => (steering ? steering.expose(stops) : viewer.expose(stops));
  return [[
    { text: t('Exposure'), share: 3 }, { id: 'darker', icon: 'less', run: by(-0.5), repeats: true }, { text: signed(now), share: 1.5 },
    { id: 'brighter', icon: 'more', run: by(0.5), repeats: true },
  ]];
}

// The studio's numbers: start and end of the merge.
function mergeRows({ viewer }) {
  if (!viewer.scene) return [];
  return viewer.steering.numbers().map(({ id, text, value, least, most, set }) => [
    { text, share: 3 },
    { id, part: stepped((value - least) / (most - least)), share: 5, drag: (part, isLast) => set(least + part * (most - least), isLast) },
    { text: `${value.toFixed(1)}°`, share: 1.6 },
  ]);
}

export function controlsOf(headset, panel) {
  const { viewer } = headset;
  const { state } = viewer;
  const entries = entriesOf(headset);
  const worn = Math.max(WORN.findIndex(({ name }) => name === state.worn), 0);
  const many = entries.length > 1;
  return lay([
    [{ text: panel.message || pointedAt(panel, viewer.guide) || itemName(viewer.about), share: 9, isName: true }, { id: 'close', icon: 'close', run: () => panel.close() }],
    ...(isMapped(viewer.guide) ? [] : listRows(panel, entries)),
    ...guideRows(panel, viewer),
    ...videoRows(viewer),
    [
      ...(many ? [{ id: 'previous', icon: 'previous', run: () => viewer.go(-1) }, { id: 'next', icon: 'next', run: () => viewer.go(1) }] : []),
      { id: 'mode', text: t(WORN[worn].label), on: worn > 0, share: 3, run: () => viewer.set({ worn: WORN[(worn + 1) % WORN.length].name }) },
      { id: 'swap', text: t('Swap eyes'), on: state.swap, share: 3, run: () => viewer.set({ swap: !state.swap }) },
    ],
    ...exposureRow(headset),
    ...mergeRows(headset),
    [
      { id: 'turn-left', text: t('Turn left'), share: 3, run: () => headset.turnBy(-TURN), repeats: true },
      { id: 'recentre', text: t('Recentre'), share: 3, run: () => headset.recentre() },
      { id: 'turn-right', text: t('Turn right'), share: 3, run: () => headset.turnBy(TURN), repeats: true },
    ],
    [
      ...(viewer.scene ? [{ id: 'sides', text: `Settings ${viewer.steering.side}`, share: 3, run: () => viewer.steering.select() }] : []),
      { id: 'leave', text: t('Leave'), share: 3, run: () => headset.session.end() },
    ],
  ]);
}

function fitted(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  let length = text.length;
  while (length && context.measureText(`${text.slice(0, length)}…`).width > width) length--;
  return `${text.slice(0, length)}…`;
}

function paintOne(context, { box, round = 16, text, icon, image, part, on, run, isName, paint }, isHovered) {
  const [x, y, width, height] = box;
  const fill = (style, ...box) => {
    context.fillStyle = style;
    context.beginPath();
    context.roundRect(...box, round);
    context.fill();
  };
  if (part !== undefined) {
    const [left, long, middle] = [x + 16, width - 32, y + height / 2];
    fill(isHovered ? '#55585e' : '#44474c', left, middle - 9, long, 18);
    fill('#ffb648', left, middle - 9, part * long, 18);
    fill('#ffffff', left + part * long - 13, middle - 26, 26, 52);
    return;
  }
  if (run) fill(on ? '#ffb648' : isHovered ? '#55585e' : '#34373c', x, y, width, height);
  if (on && isHovered) fill('#ffd08a', x, y, width, height);
  const ink = on ? '#1b1c1e' : '#f4f4f2';
  Object.assign(context, { fillStyle: ink, strokeStyle: ink, textBaseline: 'middle', textAlign: isName ? 'left' : 'center' });
  paint?.(context, box, isHovered, ink);
  if (icon) {
    const middle = new DOMMatrix().translate(x + (text ? 46 : width / 2), y + height / 2).scale(2.4).translate(-12, -12);
    const path = new Path2D();
    path.addPath(new Path2D(ICONS[icon]), middle);
    Object.assign(context, { lineWidth: 5, lineCap: 'round', lineJoin: 'round' });
    if (SOLID.includes(icon)) context.fill(path);
    else context.stroke(path);
  }
  const [high, wide] = [height - 12, 2 * (height - 12)];
  if (image) {
    const scale = Math.max(wide / image.width, high / image.height);
    const part = [wide / scale, high / scale];
    context.drawImage(image, (image.width - part[0]) / 2, (image.height - part[1]) / 2, ...part, x + 6, y + 6, wide, high);
  }
  const from = image ? wide + 24 : 20;
  const room = width - (isName ? from + 20 : icon ? 84 : 20);
  if (text) context.fillText(isName ? fitted(context, text, room) : text, isName ? x + from : x + width / 2 + (icon ? 28 : 0), y + height / 2 + 3, room);
}

export function paint(canvas, { high, controls }, hovered, width = WIDE) {
  Object.assign(canvas, { width, height: high });
  const context = canvas.getContext('2d');
  context.font = `${TEXT}px system-ui, sans-serif`;
  context.fillStyle = '#1d1f22';
  context.beginPath();
  context.roundRect(0, 0, width, high, 32);
  context.fill();
  for (const control of controls) paintOne(context, control, hovered.has(control.id));
}
