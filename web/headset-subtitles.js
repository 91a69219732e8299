// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The subtitle of a video in the headset: a sheet below the middle of the view, which stays in the room until the next
// text, or until the wearer has turned away.
import { radians } from './geometry.js';
import { headingOf, sheetAhead, turnBetween } from './headset-room.js';

const WIDE = 1400; // pixels
const LINE = 64;
const PAD = 20;
const DISTANCE = 1.5; // metres
const PIXEL = 1.2 / WIDE; // metres
const BELOW = radians(22);
const LOST = radians(40);

// The lines of a text, broken at spaces where it is too wide.
function linesOf(text, fits) {
  return text.split('\n').flatMap((line) => {
    const lines = [''];
    for (const word of line.split(' ')) {
      const longer = `${lines.at(-1)} ${word}`.trim();
      if (!lines.at(-1) || fits(longer)) lines[lines.length - 1] = longer;
      else lines.push(word);
    }
    return lines;
  });
}

export class HeadsetSubtitles {
  // sheets: of headset-room.js, which draw it.
  constructor(sheets, gl) {
    Object.assign(this, { sheets, gl, text: '', sheet: null, face: gl.createTexture(), canvas: new OffscreenCanvas(WIDE, LINE) });
  }

  free() {
    this.gl.deleteTexture(this.face);
  }

  // head: its pose in the room.
  update(text, head) {
    const heading = headingOf(head);
    if (text === this.text && !(this.sheet && Math.abs(turnBetween(this.heading, heading)) > LOST)) return;
    if (text && text !== this.text) this.paint(text);
    Object.assign(this, { text, heading });
    const { width, height } = this.canvas;
    this.sheet = text ? { ...sheetAhead(head.at, heading, BELOW, DISTANCE, [width * PIXEL, height * PIXEL]), face: this.face } : null;
  }

  paint(text) {
    const { canvas } = this;
    const context = canvas.getContext('2d');
    const font = `${LINE * 0.72}px system-ui, sans-serif`;
    context.font = font;
    const lines = linesOf(text, (line) => context.measureText(line).width <= WIDE - 2 * PAD);
    canvas.height = lines.length * LINE + 2 * PAD;
    Object.assign(context, { font, textAlign: 'center', textBaseline: 'middle', fillStyle: 'rgb(0 0 0 / 0.7)' });
    context.fillRect(0, 0, WIDE, canvas.height);
    context.fillStyle = '#fff';
    lines.forEach((line, i) => context.fillText(line, WIDE / 2, PAD + (i + 0.5) * LINE, WIDE - 2 * PAD));
    this.sheets.fill(this.face, canvas);
  }
}
