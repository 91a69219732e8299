// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The film of a layered scene (ods layers --frames): an animation moves its meshes, and their light is mixed of two textures.
import { matrixOf, multiplied } from './glb.js';
import { check } from './meshopt.js';

const SLOW = 100; // milliseconds: time that passes in a pause does not count
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
export function readFilm(glb, { lights }, meshes) {
  check(Array.isArray(lights) && isAscending(lights), 'its animation is damaged');
  const [animation] = glb.json.animations ?? [];
  const tracks = (animation?.channels ?? []).map((channel) => readTrack(glb, animation, channel));
  for (const mesh of meshes) {
    const textures = mesh.material.extras?.omnistereo?.lights;
    if (!textures) continue;
    check(textures.length === lights.length, 'its light is damaged');
    const own = tracks.filter(({ node }) => node === mesh.index);
    Object.assign(mesh, { lights: textures.map((texture) => glb.imageOf(texture)), tracks: own, shapes: shapesOf(glb, mesh.primitive) });
    check(!mesh.shapes || own.some(({ path, size }) => path === 'weights' && size === mesh.shapes.length - 1), 'its animation is damaged');
  }
  return new Film(lights, Math.max(lights.at(-1), ...tracks.map(({ times }) => times.at(-1))));
}

class Film {
  constructor(lights, end) {
    Object.assign(this, { lights, end, time: 0, isPaused: matchMedia('(prefers-reduced-motion: reduce)').matches, keys: FILM_KEYS });
  }

  // The meshes are on the GPU: they have `textures`, one for each light.
  begin(meshes, gl) {
    this.gl = gl;
    this.meshes = meshes.filter(({ lights }) => lights);
    this.show(0);
  }

  // Before every picture: plays, and asks for the next one.
  refresh(viewer) {
    const now = performance.now();
    const passed = Math.min(now - (this.last ?? now), SLOW) / 1000;
    this.last = now;
    if (this.isPaused || !this.end) return;
    this.show((this.time + passed) % this.end);
    if (!viewer?.session) viewer?.redraw();
  }

  // Sets everything to a time, seconds.
  show(time) {
    this.time = time;
    const { from, to, part } = placeIn(this.lights, time);
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

  toggle(viewer) {
    this.isPaused = !this.isPaused;
    viewer.redraw();
  }
}

// The keys of films (actions.js).
const FILM_KEYS = [{
  id: 'film-play', keys: [' '], shown: 'Space', label: 'play, pause', group: 'Video', run: (player, viewer) => viewer.picture.film.toggle(viewer),
}];
