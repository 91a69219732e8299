// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The merge as a curve: the remaining fraction of the eye distance from straight down to straight up. Its ends can be
// dragged. The formula is the kernel's, run on the GPU by merge-curve.frag.
import { clamp, radians } from './geometry.js';
import { compile } from './panorama.js';

const COUNT = 181;
const SIZE = [280, 92]; // width and height of the drawing
const BOX = [8, 272, 10, 82]; // box of the curve in it: left, right, top, bottom
const ENDS = [['top', 'start'], ['top', 'end'], ['bottom', 'start'], ['bottom', 'end']];
const REACH = 24; // distance at which a finger grabs a handle
const SVG = 'http://www.w3.org/2000/svg';

const xOf = (elevation) => BOX[0] + ((elevation + 90) / 180) * (BOX[1] - BOX[0]);
const yOf = (left) => BOX[3] - left * (BOX[3] - BOX[2]);

// Fractions for -90 .. 90 degrees, for two merges of a sidecar.
class Formula {
  // kinds: the kernel's number of each merge.
  constructor(text, kinds) {
    this.kinds = kinds;
    const gl = (this.gl = new OffscreenCanvas(COUNT, 1).getContext('webgl2', { alpha: false, antialias: false }));
    this.program = compile(gl, text);
    gl.useProgram(this.program);
    gl.bindVertexArray(gl.createVertexArray());
    gl.disable(gl.DITHER);
  }

  values(merges) {
    const { gl, program } = this;
    merges.forEach(({ mode, start, end, exponent }, i) => {
      const at = (name) => gl.getUniformLocation(program, `merges[${i}].${name}`);
      gl.uniform1i(at('mode'), this.kinds[mode]);
      gl.uniform1f(at('start'), radians(start));
      gl.uniform1f(at('end'), radians(end));
      gl.uniform1f(at('exponent'), exponent);
    });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const bytes = new Uint8Array(4 * COUNT);
    gl.readPixels(0, 0, COUNT, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return Array.from({ length: COUNT }, (_, i) => (bytes[4 * i] + bytes[4 * i + 1] / 255) / 255);
  }
}

function shape(tag, attributes, parent) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  parent.append(element);
  return element;
}

export class MergeCurve {
  // onDrag(which, end, elevation, gesture): which is top or bottom, end is start or end; the gesture is null at the
  // end.
  constructor(kinds, onDrag) {
    this.onDrag = onDrag;
    this.element = document.createElement('figure');
    this.element.className = 'curve';
    const svg = shape('svg', { viewBox: `0 0 ${SIZE.join(' ')}`, role: 'img' }, this.element);
    svg.setAttribute('aria-label', 'Eye distance from straight down to straight up');
    this.svg = svg;
    for (const left of [0, 0.5, 1]) shape('line', { class: 'grid', x1: BOX[0], x2: BOX[1], y1: yOf(left), y2: yOf(left) }, svg);
    for (const at of [-60, -30, 0, 30, 60]) shape('line', { class: 'grid', x1: xOf(at), x2: xOf(at), y1: BOX[2], y2: BOX[3] }, svg);
    this.fill = shape('polygon', { class: 'fill' }, svg);
    this.other = shape('polyline', { class: 'other' }, svg);
    this.auto = shape('polyline', { class: 'auto' }, svg);
    shape('title', {}, this.auto).textContent = 'What the depth allows: --merge auto';
    this.line = shape('polyline', { class: 'curve-line' }, svg);
    this.gaze = shape('line', { class: 'gaze', y1: BOX[2] - 6, y2: BOX[3] + 6 }, svg);
    const words = shape('text', { x: SIZE[0] / 2, y: yOf(0.7), 'text-anchor': 'middle' }, svg);
    words.textContent = 'full eye distance';
    this.handles = ENDS.map(([which, end]) => ({ which, end, circle: shape('circle', { class: 'handle', r: 6 }, svg) }));
    this.drag();
    const caption = document.createElement('figcaption');
    caption.append(...['straight down', 'horizon', 'straight up'].map((text) => Object.assign(document.createElement('span'), { textContent: text })));
    this.element.append(caption);
    fetch('merge-curve.frag').then((answer) => answer.text()).then((text) => {
      this.formula = new Formula(text, kinds);
      if (this.last) this.draw(...this.last);
    }).catch((error) => console.warn(error.message));
  }

  // Fingers need not hit a handle; the nearest one is dragged.
  drag() {
    const { svg } = this;
    let held = null;
    const place = (event) => {
      const box = svg.getBoundingClientRect();
      return [((event.clientX - box.left) / box.width) * SIZE[0], ((event.clientY - box.top) / box.height) * SIZE[1]];
    };
    const give = (event, isDragging) => {
      const at = ((place(event)[0] - BOX[0]) / (BOX[1] - BOX[0])) * 180 - 90;
      this.onDrag(held.which, held.end, clamp(Math.round(held.which === 'top' ? at : -at), 0, 90), held.gesture, isDragging);
    };
    svg.addEventListener('pointerdown', (event) => {
      const [x, y] = place(event);
      const far = ({ circle }) => Math.hypot(circle.getAttribute('cx') - x, circle.getAttribute('cy') - y);
      const [nearest] = this.handles.filter(({ circle }) => !circle.hasAttribute('hidden')).sort((a, b) => far(a) - far(b));
      if (!nearest || far(nearest) > REACH) return;
      svg.setPointerCapture(event.pointerId);
      held = { ...nearest, gesture: {} };
      event.preventDefault();
    });
    svg.addEventListener('pointermove', (event) => held && give(event, true));
    for (const name of ['pointerup', 'pointercancel']) {
      svg.addEventListener(name, (event) => {
        if (held && name === 'pointerup') give(event, false);
        held = null;
      });
    }
  }

  // merges: { top, bottom } of a sidecar, and map, the shares of its merge map from the zenith down, if it has one;
  // other: those of the other side, or null.
  draw(merges, other) {
    this.last = [merges, other];
    if (!this.formula) return;
    const shareOf = (map, i) => map[clamp(Math.floor(((COUNT - i) / COUNT) * map.length), 0, map.length - 1)];
    const points = ({ top, bottom, map }) => this.formula.values([top, bottom]).map((left, i) => {
      const isOfMap = map && (i < 90 ? bottom : top).mode === 'map';
      return `${xOf(i - 90).toFixed(1)},${yOf(isOfMap ? shareOf(map, i) : left).toFixed(1)}`;
    });
    const line = points(merges);
    this.line.setAttribute('points', line.join(' '));
    this.fill.setAttribute('points', [`${BOX[0]},${BOX[3]}`, ...line, `${BOX[1]},${BOX[3]}`].join(' '));
    this.other.setAttribute('points', other ? points(other).join(' ') : '');
    const values = line.map((point) => Number(point.split(',')[1]));
    for (const { circle, which, end } of this.handles) {
      const merge = merges[which];
      const at = which === 'top' ? merge[end] : -merge[end];
      circle.setAttribute('cx', xOf(at));
      circle.setAttribute('cy', values[Math.round(at) + 90] ?? BOX[3]);
      circle.toggleAttribute('hidden', merge.mode === 'none' || merge.mode === 'map');
    }
  }

  // shares: the fractions that the depth allows (--merge auto), from the zenith down.
  drawAuto(shares) {
    const at = (i) => 90 - ((i + 0.5) * 180) / shares.length;
    this.auto.setAttribute('points', shares.map((left, i) => `${xOf(at(i)).toFixed(1)},${yOf(left).toFixed(1)}`).join(' '));
  }

  look(pitch) {
    this.gaze.setAttribute('x1', xOf(pitch));
    this.gaze.setAttribute('x2', xOf(pitch));
  }
}
