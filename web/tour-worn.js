// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The spots of a picture in the headset: signs and rings in the room, which each eye sees as it sees the picture there
// (seenBy()), at every position of the head. Pointers and the gaze choose them (headset-panel.js).
import { meet, plus, scaled, turned } from './headset-room.js';
import { pointAt, RING, seenBy } from './tour-ways.js';

const TEXT = 46; // pixels: height of a line
const HIGH = 84; // pixels
const PIXEL = 0.00062; // metres at a distance of one metre: letters are as high as the menu's
const WHITE = [1, 1, 1, 0.9];
const ACCENT = [1, 0.71, 0.28, 1];

function paint({ title, to }, isHovered) {
  const text = to === undefined ? `ⓘ ${title}` : title;
  const canvas = new OffscreenCanvas(1, HIGH);
  const font = `600 ${TEXT}px system-ui, sans-serif`;
  const measure = canvas.getContext('2d');
  measure.font = font;
  canvas.width = Math.min(Math.ceil(measure.measureText(text).width) + 72, 1024);
  const context = canvas.getContext('2d');
  Object.assign(context, { font, textAlign: 'center', textBaseline: 'middle', fillStyle: isHovered ? '#ffb648' : '#1d1f22', strokeStyle: '#ffffff', lineWidth: 5 });
  context.beginPath();
  context.roundRect(4, 4, canvas.width - 8, HIGH - 8, (HIGH - 8) / 2);
  context.fill();
  context.stroke();
  context.fillStyle = isHovered ? '#1b1c1e' : '#ffffff';
  context.fillText(text, canvas.width / 2, HIGH / 2 + 3, canvas.width - 48);
  return canvas;
}

// A sheet that faces an eye from a point relative to it; upright, but for the tilt towards the eye.
function sign(at, [width, height]) {
  const [x, , z] = at;
  const right = [-z, 0, x];
  const up = [-x * at[1], x * x + z * z, -z * at[1]];
  return { u: scaled(right, width / 2), v: scaled(up, height / 2) };
}

export class WornSpots {
  // panel: of headset-panel.js.
  constructor(guide, { headset, sheets, gl }) {
    Object.assign(this, { guide, headset, sheets, gl, faces: [], hovered: '' });
    this.heard = new AbortController();
    guide.addEventListener('spots', () => this.fill(), { signal: this.heard.signal });
    this.fill();
  }

  // A face for each spot, and one for when a pointer is on it.
  fill() {
    this.empty();
    this.faces = this.guide.spots.map((spot) => [false, true].map((isHovered) => {
      const canvas = paint(spot, isHovered);
      const texture = this.gl.createTexture();
      this.sheets.fill(texture, canvas);
      return { texture, width: canvas.width };
    }));
  }

  empty() {
    for (const { texture } of this.faces.flat()) this.gl.deleteTexture(texture);
    this.faces = [];
  }

  free() {
    this.heard.abort();
    this.empty();
    this.guide.worn = null;
  }

  get isSeen() {
    return this.faces.length > 0;
  }

  get camera() {
    const { picture } = this.headset.viewer;
    return picture?.mono ? undefined : picture?.camera;
  }

  // A point of the picture as an eye sees it, from there, in the room.
  seen(side, point) {
    return turned(pointAt(seenBy(side, point, this.camera), Math.hypot(...point)), -this.headset.turn);
  }

  sizeOf(i, at) {
    return [this.faces[i][0].width, HIGH].map((pixels) => pixels * PIXEL * Math.hypot(...at));
  }

  // The spot that a ray from near the head meets, as a hit and a control of the panel; null for none.
  find({ from, along }, head) {
    for (const [i, { at, foot, run }] of this.guide.spots.entries()) {
      const middle = this.seen(0, at);
      const sheets = [{ at: plus(head, middle), ...sign(middle, this.sizeOf(i, middle)) }];
      if (foot) sheets.push({ at: plus(head, this.seen(0, foot)), u: [RING, 0, 0], v: [0, 0, -RING] });
      const hit = sheets.map((sheet) => meet(sheet, { from, along })).find((each) => each?.isInside);
      if (hit) return { hit, control: { id: `spot-${i}`, isSpot: true, run } };
    }
    return null;
  }

  // index: 0 for the left eye. The sheets to draw for an eye at a position.
  things({ eye, index }, hovered) {
    const side = index ? -1 : 1;
    return this.guide.spots.flatMap((spot, i) => {
      const isHovered = hovered.has(`spot-${i}`);
      const at = this.seen(side, spot.at);
      const things = [];
      if (spot.foot) {
        const foot = this.seen(side, spot.foot);
        things.push({ at: plus(eye, foot), u: [RING, 0, 0], v: [0, 0, -RING], color: isHovered ? ACCENT : WHITE, ring: [0.82, 1] });
      }
      things.push({ at: plus(eye, at), ...sign(at, this.sizeOf(i, at)), face: this.faces[i][isHovered ? 1 : 0].texture });
      return things;
    });
  }
}
