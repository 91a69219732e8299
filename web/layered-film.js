// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The film of a layered scene (ods layers --frames): an animation moves its meshes, and their light is mixed of two
// textures, as is the change of the still meshes' light. To the bar, the keys and the headset it is a video.
import { matrixOf, multiplied } from './glb.js';
import { clamp } from './geometry.js';
import { check } from './meshopt.js';

const SLOW = 100; // milliseconds: time that passes in a pause does not count
const FPS = 30; // of a film in which nothing but light changes
const SIZES = { translation: 3, rotation: 4, scale: 3 };

// The place of a time in an ascending list: an index, the next one, and how far it is between them.
function placeIn(times, time) {
  const next = times.findIndex((at) => at > time);
  if (next <= 0) return { from: next ? times.length - 1 : 0, to: next ? times.length - 1 : 0, part: 0 };
  return { from: next - 1, to: next, part: (time - times[next - 1]) / (times[next] - times[next - 1]) };
}

const isAscending = (list) => list.length > 0 && list.every((value, i) => Number.isFinite(value) && (i ? value > list[i - 1] : value >= 0));

// { node, path, times, values, size, isStep }
function readTrack(glb, { samplers }, { sampler, target }) {
  const { input, output, interpolation = 'LINEAR' } = samplers[sampler];
  const times = glb.floats(input, 1);
  const values = glb.floats(output, { rotation: 4, weights: 1 }[target.path] ?? 3);
  const size = values.length / times.length;
  check(isAscending(times) && (SIZES[target.path] ?? (target.path === 'weights' && size)) === size, 'its animation is damaged');
  return { ...target, times, values, size, isStep: interpolation === 'STEP' };
}

// The positions of a mesh at each of its frames, or none.
function shapesOf(glb, { attributes, targets = [] }) {
  const first = targets.length ? glb.floats(attributes.POSITION, 3) : null;
  return first && [first, ...targets.map(({ POSITION }) => {
    const moved = glb.floats(POSITION, 3);
    check(moved.length === first.length, 'its animation is damaged');
    return moved.map((value, i) => value + first[i]);
  })];
}

// Reads the film of a file, whose meshes layered.js has read. Those that move get `lights`, the images of their light.
export function readFilm(glb, { lights, changes = [] }, meshes) {
  check(Array.isArray(lights) && isAscending(lights), 'its animation is damaged');
  check(Array.isArray(changes) && [0, lights.length].includes(changes.length), 'its light is damaged');
  const [animation] = glb.json.animations ?? [];
  const tracks = (animation?.channels ?? []).map((channel) => readTrack(glb, animation, channel));
  for (const mesh of meshes) {
    const { lights: textures, change } = mesh.material.extras?.omnistereo ?? {};
    if (change && changes.length) {
      check(Array.isArray(change) && change.length === 8 && change.every(Number.isFinite), 'its light is damaged');
      mesh.change = { place: change };
    }
    if (!textures) continue;
    check(textures.length === lights.length, 'its light is damaged');
    const own = tracks.filter(({ node }) => node === mesh.index);
    Object.assign(mesh, { lights: textures.map((texture) => glb.imageOf(texture)), tracks: own, shapes: shapesOf(glb, mesh.primitive) });
    check(!mesh.shapes || own.some(({ path, size }) => path === 'weights' && size === mesh.shapes.length - 1), 'its animation is damaged');
  }
  const times = tracks.map((track) => track.times).find((each) => each.length > 1);
  const end = Math.max(lights.at(-1), ...tracks.map((track) => track.times.at(-1)));
  return new Film(lights, changes.map((texture) => glb.imageOf(texture)), end, times ? (times.length - 1) / times.at(-1) : FPS);
}

class Film {
  constructor(lights, changes, end, fps) {
    Object.assign(this, { lights, changes, end, fps, time: 0, paused: matchMedia('(prefers-reduced-motion: reduce)').matches });
    Object.assign(this, { muted: true, seeking: false, playbackRate: 1 });
  }

  get currentTime() {
    return this.time;
  }

  // Gives a picture what one of a video has (video.js).
  control(picture) {
    const { end, fps } = this;
    const frames = Math.round(end * fps) + 1;
    const frame = () => Math.floor(this.time * fps + 1e-4);
    const seek = (seconds) => {
      this.show(clamp(Math.floor(seconds * fps + 1e-4), 0, frames - 1) / fps);
      picture.changed?.();
    };
    Object.assign(picture, {
      film: this, video: this, fps, frames, frame, seek, loops: true,
      loop(is) {
        picture.loops = is;
        picture.changed?.();
      },
      toggle: () => (this.paused ? this.play() : this.pause()),
      step: (count) => {
        this.pause();
        seek((frame() + count) / fps);
      },
    });
    this.picture = picture;
  }

  async play() {
    if (this.time >= this.end) this.show(0);
    Object.assign(this, { paused: false, last: undefined });
    this.picture.changed?.();
  }

  pause() {
    this.paused = true;
    this.picture.changed?.();
  }

  // The meshes are on the GPU: they have `textures`, one for each light. changed: those of the changes.
  begin(meshes, gl, changed) {
    Object.assign(this, { gl, changed, still: meshes.filter(({ change }) => change), meshes: meshes.filter(({ lights }) => lights) });
    this.show(0);
  }

  // Before every picture: plays, and asks for the next one.
  refresh() {
    const now = performance.now();
    const passed = (Math.min(now - (this.last ?? now), SLOW) / 1000) * this.playbackRate;
    this.last = now;
    if (this.paused || !this.end) return;
    const time = this.time + passed;
    const isOver = time >= this.end && !this.picture.loops;
    this.show(isOver ? this.end : time % this.end);
    if (isOver) this.pause();
    else this.picture.changed?.();
  }

  // Sets everything to a time, seconds.
  show(time) {
    this.time = time;
    const { from, to, part } = placeIn(this.lights, time);
    for (const { change } of this.still) Object.assign(change, { now: this.changed[from], next: this.changed[to], part });
    for (const mesh of this.meshes) {
      Object.assign(mesh, { texture: mesh.textures[from], next: mesh.textures[to], part });
      this.move(mesh, time);
    }
  }

  move(mesh, time) {
    const node = { ...mesh.node };
    for (const { path, times, values, size, isStep } of mesh.tracks) {
      const { from, to, part } = placeIn(times, time);
      if (path === 'weights') {
        this.bend(mesh, from, to, part);
        continue;
      }
      const [a, b] = [from, to].map((frame) => values.subarray(size * frame, size * frame + size));
      const mixed = Array.from(a, (value, i) => (isStep ? value : value + (b[i] - value) * part));
      const long = path === 'rotation' ? Math.hypot(...mixed) || 1 : 1;
      node[path] = mixed.map((value) => value / long);
    }
    mesh.matrix = multiplied(mesh.above, matrixOf(node));
  }

  // Every frame has a shape of its own.
  bend({ shapes, positions: { buffer } }, from, to, part) {
    const { gl } = this;
    const b = shapes[to];
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, shapes[from].map((value, i) => value + (b[i] - value) * part), gl.DYNAMIC_DRAW);
  }
}
