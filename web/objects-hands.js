// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Drags objects over the surfaces of a layered scene, or of a picture with depth: an object that is grabbed follows the pointer, standing on what is
// below it or touching the wall behind it. The wheel turns it.
import { dot, radians } from './geometry.js';
import { plus, scaled, turned } from './headset-room.js';
import { castOne } from './objects-surface.js';
import { directionAt } from './places.js';
import { raysOf } from './panorama.js';

const NEAR = 0.01; // metres that a surface may be in front of the place that is grabbed
const START = 4; // pixels of movement until a drag begins
const TURN = 5; // degrees of a line of the wheel

// The way back of a matrix, for points.
function inverseOf(m) {
  const [a, b, c] = [0, 4, 8].map((i) => [m[i], m[i + 1], m[i + 2]]);
  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const rows = [cross(b, c), cross(c, a), cross(a, b)].map((row) => row.map((x) => x / dot(a, cross(b, c))));
  return (p, isPoint) => rows.map((row) => dot(row, isPoint ? plus(p, m.slice(12, 15), -1) : p));
}

export class Hands {
  constructor(objects) {
    const { viewer, viewer: { element } } = objects;
    Object.assign(this, { objects, viewer, element, held: null, heard: new AbortController() });
    const on = (event, run) => element.addEventListener(event, run, { signal: this.heard.signal, capture: true, passive: false });
    on('pointerdown', (event) => this.grab(event));
    on('pointermove', (event) => this.follow(event));
    for (const end of ['pointerup', 'pointercancel']) on(end, (event) => this.release(event));
    on('wheel', (event) => this.turn(event));
    window.addEventListener('keydown', (event) => this.key(event), { signal: this.heard.signal, capture: true });
  }

  free() {
    this.heard.abort();
    this.element.style.cursor = '';
  }

  // The ray below a pointer, in the scene's axes; null outside of the view.
  rayAt({ clientX, clientY }) {
    const { viewer, element, objects: { picture } } = this;
    const { left, top } = element.getBoundingClientRect();
    const direction = directionAt(viewer, clientX - left, clientY - top);
    if (!direction) return null;
    const side = direction.eye === 'right' ? 1 : 0;
    const shift = radians(viewer.state.shift) / 2;
    if (picture.stage) return picture.stage.rayOf(raysOf(direction, 1).slice(6, 9), side, shift);
    const along = turned(raysOf(direction, 1).slice(6, 9), picture.about.turn + (side ? -shift : shift));
    return { from: picture.toWorld(picture.eyesOf(viewer.state, raysOf(viewer.state, 1))[side]), along: scaled(along, 1) };
  }

  // The object that a ray meets before any surface.
  objectAt({ from, along }) {
    let found = null;
    let distance = Infinity;
    for (const object of this.objects.all) {
      const { middle, radius, pose, matrix } = object;
      const toward = plus(middle, from, -1);
      if (Math.hypot(...plus(toward, along, -dot(toward, along))) > radius) continue;
      const back = inverseOf(matrix);
      for (const { positions, matrices, indices } of object.file.parts) {
        const own = inverseOf([...(matrices[pose.frame] ?? matrices[0])]);
        const way = castOne({ positions: positions[pose.frame] ?? positions[0], indices }, own(back(from, true), true), own(back(along)), { isDouble: true });
        if (way.distance < distance) [found, distance] = [object, way.distance];
      }
    }
    const before = found && this.objects.surfaces.cast(from, along);
    return before && before.distance < distance - NEAR ? null : found;
  }

  grab(event) {
    if (event.button || this.held || event.shiftKey || this.viewer.session) return;
    const ray = this.rayAt(event);
    const object = ray && this.objectAt(ray);
    if (!object) return this.objects.choose(null);
    event.preventDefault(); // the view does not turn
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    this.objects.choose(object);
    // The place of the object that follows the pointer: where it stands.
    const foot = plus(object.at, [0, 1, 0], object.file.low[1]);
    const aim = scaled(plus(foot, ray.from, -1), 1);
    this.held = { object, id: event.pointerId, x: event.clientX, y: event.clientY, apart: plus(aim, ray.along, -1), before: { at: object.at, turn: object.turn } };
  }

  follow(event) {
    const { held, objects } = this;
    if (!held) return this.hover(event);
    if (event.pointerId !== held.id) return;
    if (!held.isMoving && Math.hypot(event.clientX - held.x, event.clientY - held.y) < START) return;
    const { object, apart, before } = held;
    if (!held.isMoving) objects.past.push({ object, ...before });
    held.isMoving = true;
    const ray = this.rayAt(event);
    const on = ray && objects.surfaces.cast(ray.from, scaled(plus(ray.along, apart), 1));
    if (on) objects.move(object, { at: this.restOn(object, on) }, true);
  }

  // The place at which an object touches a surface and is on its front.
  restOn({ matrix, file: { low, high } }, { at, normal }) {
    const turn = (p) => [0, 1, 2].map((i) => matrix[i] * p[0] + matrix[4 + i] * p[1] + matrix[8 + i] * p[2]);
    const upright = normal[1] > 0.7 ? [0, 1, 0] : normal; // floors and tables that are not quite level
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => turn(low.map((value, i) => ((n >> i) & 1 ? high[i] : value))));
    return plus(at, upright, -Math.min(...corners.map((corner) => dot(corner, upright))));
  }

  // The pointer shows that it can be grabbed.
  hover(event) {
    if (event.buttons || event.pointerType === 'touch' || this.viewer.session) return;
    const ray = this.rayAt(event);
    this.element.style.cursor = ray && this.objectAt(ray) ? 'move' : '';
  }

  release(event) {
    if (this.held?.id !== event.pointerId) return;
    event.preventDefault();
    this.held = null;
  }

  // Escape ends a drag where it began.
  key(event) {
    const { held, objects } = this;
    if (event.key !== 'Escape' || !held?.isMoving) return;
    event.preventDefault();
    this.held = null;
    objects.past.pop();
    objects.move(held.object, held.before, true);
  }

  turn(event) {
    const { held, objects } = this;
    if (!held) {
      const ray = objects.chosen && this.rayAt(event);
      if (!ray || this.objectAt(ray) !== objects.chosen) return;
    }
    event.preventDefault(); // nothing zooms
    const lines = event.deltaMode === 0 ? event.deltaY / 40 : event.deltaY;
    objects.turnBy(TURN * (Math.round(lines) || Math.sign(lines)));
  }
}
