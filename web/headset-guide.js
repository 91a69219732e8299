// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a guide (tour.js) in the headset's menu: the plan with the places of a tour and a cone for the view, the
// compass, and the text of the panorama. A press on a place leads there.
import { radians } from './geometry.js';
import { t } from './translate.js';

const [PLAN, DOT] = [360, 52]; // pixels
const CONE = [radians(45), 90]; // half its width, its length in pixels

// The corner of the plan within a box, and the scale from the image's pixels.
function fitted({ width, height }, [x, y, wide, high]) {
  const scale = Math.min(wide / width, high / height);
  return [x + (wide - width * scale) / 2, y + (high - height * scale) / 2, scale];
}

function edge(context, box) {
  Object.assign(context, { lineWidth: 4, strokeStyle: '#fff' });
  context.beginPath();
  context.roundRect(...box, DOT / 2);
  context.stroke();
}

// image: null until it is loaded.
function planCell(guide, image) {
  if (!image) return { high: PLAN };
  const { dots, item, heading, tour: { plan } } = guide;
  const at = (box, [left, top]) => {
    const [x, y, scale] = fitted(image, box);
    return [x + left * scale, y + top * scale];
  };
  const paint = (context, box) => {
    const [x, y, scale] = fitted(image, box);
    const whole = [x, y, image.width * scale, image.height * scale];
    context.fillStyle = '#fff';
    context.fillRect(...whole);
    context.drawImage(image, ...whole);
    if (!dots[item]) return;
    const here = at(box, dots[item]);
    const middle = radians((heading ?? 0) - (plan.heading ?? 0) - 90);
    context.fillStyle = 'rgb(194 94 0 / 62%)';
    context.beginPath();
    context.moveTo(...here);
    context.arc(...here, CONE[1], middle - CONE[0], middle + CONE[0]);
    context.fill();
  };
  const inside = (box) => dots.flatMap((dot, i) => {
    if (!dot) return [];
    const [x, y] = at(box, dot);
    return { id: `place-${i}`, box: [x - DOT / 2, y - DOT / 2, DOT, DOT], round: DOT / 2, on: i === item, run: () => guide.go(i), paint: edge };
  });
  return { id: 'plan', high: PLAN, key: Math.round(heading), paint, inside };
}

// Returns a function that paints a compass for a heading into a box.
const paintCompass = (heading) => (context, [x, y, width, height], isHovered, ink) => {
  const radius = height / 2 - 8;
  context.save();
  context.translate(x + height / 2 + 4, y + height / 2);
  Object.assign(context, { lineWidth: 4, strokeStyle: ink, fillStyle: '#ffb648' });
  context.beginPath();
  context.arc(0, 0, radius, 0, 2 * Math.PI);
  context.stroke();
  context.rotate(radians(-heading));
  context.beginPath();
  context.moveTo(0, -radius + 4);
  context.lineTo(radius * 0.3, 6);
  context.lineTo(-radius * 0.3, 6);
  context.fill();
  context.restore();
};

// The plan stands for the list of panoramas if it has all of them.
export const isMapped = (guide) => Boolean(guide?.dots?.every(Boolean));

// The panorama whose place on the plan a pointer is on.
export function pointedAt(panel, guide) {
  const place = [...panel.hovered].find((id) => id?.startsWith('place-'));
  return place && guide.titleOf(Number(place.slice(6)));
}

export function guideRows(panel, { about, guide }) {
  if (!guide) return [];
  const { heading } = guide;
  const row = [];
  if (heading !== null) row.push({ id: 'compass', text: `${Math.round(heading) % 360}°`, share: 2, paint: paintCompass(heading) });
  if (about?.caption) row.push({ id: 'text', text: t('Text'), share: 3, run: () => guide.tellAgain(panel) });
  return [guide.dots ? [planCell(guide, panel.thumbnail(guide.tour.plan.image))] : [], row].filter(({ length }) => length);
}
