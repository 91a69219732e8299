// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A layered scene (ods layers): triangles with baked light, seen from wherever the eyes are in a small box. Loaded with
// the first such scene. It is a picture (picture.js) that draws itself, knows its box, and has keys of its own. Objects
// in it are in objects.js.
//
// Positions are metres from the middle of the box: x to the right, y up and z back, of a head that looks at yaw 0.
import { clamp, radians } from './geometry.js';
import { Glb } from './glb.js';
import { scaled, turned } from './headset-room.js';
import { LayeredDrawer } from './layered-draw.js';
import { Fault, check } from './meshopt.js';
import { download, openPicture } from './picture.js';

const VERSION = 1;
const EYE = 0.0315; // metres from the middle of the head
const LEVELS = 4; // of a texture: texels of its parts mix in smaller ones
const FADE = 0.1; // metres outside the box
const GREY = 0.85; // of the view, where there is no picture to fade to
const STEP = 0.01; // metres
const FINE = 0.002;
const LACKS = ['planet', 'swap', 'grid', 'comfort', 'layout', 'projection']; // actions and settings

const minus = (a, b) => a.map((value, i) => value - b[i]);

const isVector = (value) => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);

// The metadata of the file.
function aboutOf({ json }) {
  const about = json.asset?.extras?.omnistereo;
  check(about, 'it is a glTF scene, but not a layered one: ods layers makes one of it');
  check(about.layers === VERSION, 'a newer version of ods made it: reload the page, or update ods');
  const { center, box, yaw = 0, fallback = '', film } = about;
  check(isVector(center) && isVector(box) && box.every((side) => side > 0) && Number.isFinite(yaw), 'its box is damaged');
  return { film, center, box, turn: radians(yaw), fallback: /^[^/\\]+$/.test(fallback) ? fallback : '' };
}

// The numbers in a buffer of WebGL; a buffer view is uploaded once.
function upload(gl, made, target, { bytes, ...accessor }) {
  const key = `${target} ${accessor.view}`;
  if (!made.has(key)) {
    made.set(key, gl.createBuffer());
    gl.bindBuffer(target, made.get(key));
    gl.bufferData(target, bytes, gl.STATIC_DRAW);
  }
  return { ...accessor, buffer: made.get(key) };
}

const INDICES = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array };

function checkIndices({ bytes, offset, count, size, type, components }, vertices) {
  check(INDICES[type] && components === 1 && count % 3 === 0, 'its triangles are damaged');
  const whole = new INDICES[type](bytes.slice(offset, offset + count * size).buffer);
  for (let i = 0; i < count; i++) check(whole[i] < vertices, 'its triangles are damaged');
}

// The triangles of a primitive, without what the GPU gets of them.
function readPrimitive(glb, primitive, { matrix, node, index, above }) {
  const { attributes, indices, material: number, mode = 4 } = primitive;
  check(mode === 4 && indices !== undefined, 'it has something else than triangles with indices');
  const positions = glb.accessor(attributes?.POSITION);
  const uvs = glb.accessor(attributes?.TEXCOORD_0);
  check(positions.components === 3 && uvs.components === 2 && positions.count === uvs.count, 'its vertices are damaged');
  const material = glb.of('materials', number);
  const info = material.pbrMetallicRoughness?.baseColorTexture;
  check(info, 'it has a surface without a texture');
  const { scale = [1, 1], offset = [0, 0] } = info.extensions?.KHR_texture_transform ?? {};
  const mesh = {
    matrix, positions, uvs, indices: glb.accessor(indices), place: [...scale, ...offset], image: glb.imageOf(info.index),
    isSky: node.extras?.omnistereo?.sky === true, cutoff: material.alphaMode === 'MASK' ? material.alphaCutoff ?? 0.5 : 0,
    isBlended: material.alphaMode === 'BLEND', node, index, above, primitive, material,
  };
  checkIndices(mesh.indices, positions.count);
  return mesh;
}

// The meshes in the order in which they are drawn.
function readMeshes(glb) {
  const meshes = glb.nodes().flatMap((each) => each.mesh.primitives.map((primitive) => readPrimitive(glb, primitive, each)));
  check(meshes.length > 0, 'it has no triangles');
  const order = ({ isSky, cutoff, isBlended }) => (isSky ? 0 : isBlended ? 3 : cutoff ? 2 : 1);
  return meshes.sort((a, b) => order(a) - order(b));
}

// A texture of a decoded image.
export function textureOf(gl, source, { levels: most = LEVELS, wrap = gl.CLAMP_TO_EDGE, format = gl.SRGB8_ALPHA8 } = {}) {
  const largest = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  check(Math.max(source.width, source.height) <= largest, `its textures are larger than this GPU can hold, ${largest} pixels`);
  const texture = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  const levels = Math.min(most, 1 + Math.floor(Math.log2(Math.max(source.width, source.height))));
  gl.texStorage2D(gl.TEXTURE_2D, levels, format, source.width, source.height);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, source.width, source.height, gl.RGBA, gl.UNSIGNED_BYTE, source);
  gl.generateMipmap(gl.TEXTURE_2D);
  for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, axis, wrap);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  const sharp = gl.getExtension('EXT_texture_filter_anisotropic');
  if (sharp) gl.texParameterf(gl.TEXTURE_2D, sharp.TEXTURE_MAX_ANISOTROPY_EXT, 4);
  return texture;
}

// Reads a file into memory, without the GPU. Throws a Fault, or what damaged JSON throws.
export function readScene(buffer) {
  const glb = new Glb(buffer);
  return { glb, about: aboutOf(glb), meshes: readMeshes(glb) };
}

class LayeredPicture {
  constructor(panorama, about, item) {
    Object.assign(this, { panorama, gl: panorama.gl, about, item, eyes: [], mono: false, changed: null, actions: MOVES, lacks: LACKS });
    Object.assign(this, { drawer: new LayeredDrawer(panorama.gl), buffers: new Map(), textures: new Map(), meshes: [], heard: new AbortController() });
  }

  // Loads the triangles and the textures onto the GPU.
  async fill(glb, meshes, film, { signal }) {
    const { gl } = this;
    const changes = film?.changes ?? [];
    const images = [...new Set(meshes.flatMap(({ image, lights = [] }) => [image, ...lights])), ...changes];
    const decode = (blob) => createImageBitmap(blob, { premultiplyAlpha: 'none' }).catch(() => check(false, `this browser does not read its textures (${blob.type})`));
    const sources = images.map((image) => decode(glb.image(image)));
    for (const source of sources) source.catch(() => {}); // those after the first fault
    for (const [i, image] of images.entries()) {
      const source = await sources[i];
      signal?.throwIfAborted();
      this.textures.set(image, textureOf(gl, source, changes.includes(image) ? { levels: 1, format: gl.RGBA8 } : {}));
      source.close();
    }
    if (this.item.objects?.length) this.read = { glb, meshes: meshes.map(({ positions, indices, matrix }) => ({ positions, indices, matrix })) };
    for (const mesh of meshes) {
      if (mesh.shapes) mesh.positions = { ...mesh.positions, bytes: mesh.shapes[0], view: `shape ${this.meshes.length}`, offset: 0, stride: 12 };
      for (const name of ['positions', 'uvs']) mesh[name] = upload(gl, this.buffers, gl.ARRAY_BUFFER, mesh[name]);
      const before = gl.getParameter(gl.VERTEX_ARRAY_BINDING);
      gl.bindVertexArray(null); // which would take the indices
      mesh.indices = upload(gl, this.buffers, gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
      gl.bindVertexArray(before);
      const textures = mesh.lights?.map((image) => this.textures.get(image));
      Object.assign(mesh, { texture: this.textures.get(mesh.image), textures, array: this.drawer.arrayOf(mesh) });
      this.meshes.push(mesh);
    }
    if (!film) return;
    film.control(this);
    film.begin(this.meshes, gl, changes.map((image) => this.textures.get(image)));
  }

  // The viewer shows it from now on. Objects come after the scene, which does not wait for them.
  enter(viewer) {
    this.viewer = viewer;
    const { item, read } = this;
    if (!item.objects?.length) return;
    const begin = async () => {
      const { Objects } = await import('./objects.js');
      if (this.heard.signal.aborted) return;
      this.objects = new Objects(this, viewer, read);
      await this.objects.load();
    };
    begin().catch((error) => this.heard.signal.aborted || console.warn(error.message));
  }

  // Before every picture.
  refresh() {
    this.film?.refresh();
    this.objects?.refresh();
  }

  // A position in the file's world, and the way back.
  toWorld(at) {
    return turned(at, this.about.turn).map((value, i) => value + this.about.center[i]);
  }

  // Keeps both eyes of a state's head in the box.
  hold(state) {
    const { box, turn } = this.about;
    const inside = turned([state.x, state.y, state.z], turn).map((value, i) => {
      const most = Math.max(box[i] / 2 - (i === 1 ? 0 : EYE), 0);
      return clamp(value, -most, most);
    });
    [state.x, state.y, state.z] = turned(inside, -turn);
  }

  // The distance of a position from the box, metres; 0 inside.
  outside(at) {
    const { box, turn } = this.about;
    return Math.hypot(...turned(at, turn).map((value, i) => Math.max(Math.abs(value) - box[i] / 2, 0)));
  }

  // Both eyes of the head at the desk.
  eyesOf({ x, y, z }, rays) {
    const aside = scaled(rays.slice(0, 3), EYE);
    return [-1, 1].map((side) => [x, y, z].map((value, i) => value + side * aside[i]));
  }

  // The positions of both eyes of a headset's wearer, whose head begins in the middle; so does the state.
  follow({ session, centred, space, pose, turn }, state) {
    const place = ({ transform: { position: { x, y, z } } }) => [x, y, z];
    const head = place(pose);
    if (this.session !== session) space.addEventListener('reset', () => (this.origin = null)); // by the headset's own button
    if (this.session !== session || this.centred !== centred) this.origin = null;
    this.origin ??= head;
    // A turn by the wearer's menu is one about the head.
    if (this.turn !== turn) this.origin = minus(head, turned(turned(minus(head, this.origin), this.turn ?? turn), -turn));
    Object.assign(this, { session, centred, turn });
    const placeOf = (at) => turned(minus(at, this.origin), turn);
    [state.x, state.y, state.z] = placeOf(head);
    this.hold(state);
    return [0, 1].map((eye) => placeOf(place(pose.views.find((view) => (view.eye === 'right' ? 1 : 0) === eye) ?? pose.views[0])));
  }

  // Draws a view: the options are those of Panorama.drawOne(), with the viewer's state, and `worn` in a headset.
  draw(panorama, options) {
    const { rays, box, clip = box, show = 'eye', eye = 0, swap = false, target = null, shift = 0, state, worn } = options;
    const { about, drawer, meshes } = this;
    const eyes = worn ? this.follow(worn, state) : this.eyesOf(state, rays);
    const shown = (show === 'eye' ? [eye] : [0, 1]).map((side) => (swap ? 1 - side : side));
    if (worn) this.loadFallback();
    const away = Math.max(...eyes.map((at) => this.outside(at))); // the same for both
    const fade = clamp(away / FADE, 0, 1);
    this.isFading = fade > 0;
    if (this.isFading && this.fallback) panorama.draw(this.fallback, options);
    if (fade === 1 && this.fallback) return;
    this.objects?.prepare();
    drawer.fit(box.slice(2));
    for (const [i, side] of shown.entries()) {
      const turn = about.turn + (side ? -shift : shift);
      const own = [0, 3, 6].flatMap((at) => turned(rays.slice(at, at + 3), turn));
      const part = [clip[0] - box[0], clip[1] - box[1], clip[2], clip[3]];
      drawer.drawEye(i, meshes, { rays: own, at: this.toWorld(eyes[side]), middle: about.center, part, objects: this.objects });
    }
    const cover = this.fallback ? 1 - fade : 1;
    drawer.showEyes({ box, clip, target, show: ['eye', 'anaglyph', 'difference'].indexOf(show), cover, grey: this.fallback ? 0 : GREY * fade });
  }

  // The pager of the picture outside the box, while that is visible.
  get pager() {
    return this.isFading ? this.fallback?.pager : undefined;
  }

  // Loads the stereo picture from the middle of the box, once, if there is one.
  loadFallback() {
    const { item, panorama, about, heard: { signal } } = this;
    if (this.isAsked) return;
    this.isAsked = true;
    const beside = item.fallback === undefined && about.fallback && new URL(encodeURIComponent(about.fallback), this.address).href;
    const image = item.fallback ?? beside;
    if (!image) return;
    openPicture(panorama, { items: [] }, { ...item, kind: 'picture', image, preview: null }, { base: this.base, choice: this.choice, signal }).then((picture) => {
      if (signal.aborted) return picture.free();
      this.fallback = picture;
      this.changed?.();
    }, (error) => signal.aborted || console.warn(error.message));
  }

  free() {
    const { gl } = this;
    this.heard.abort();
    this.objects?.free();
    this.fallback?.free();
    this.meshes.forEach(({ array }) => gl.deleteVertexArray(array));
    this.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    this.textures.forEach((texture) => gl.deleteTexture(texture));
    this.drawer.free();
    this.changed = null;
  }

  // A drag of the pointer: what is a metre away follows it. degrees to the right and down.
  drag(viewer, across, down) {
    move(viewer, -radians(across), radians(down), 0);
  }
}

// Moves the head to its right, up and ahead.
function move(viewer, right, up, ahead) {
  const { x, y, z, yaw } = viewer.state;
  const [dx, , dz] = turned([right, 0, -ahead], radians(yaw));
  viewer.set({ x: x + dx, y: y + up, z: z + dz });
}

const mover = (right, up, ahead) => (step) => (player, viewer) => move(viewer, right * step, up * step, ahead * step);
const row = (key, run, more = {}) => ({ id: `move-${key}`, keys: [key], run: run(STEP), fine: run(FINE), ...more });

// The keys that move the head (actions.js).
export const MOVES = [
  row('w', mover(0, 0, 1), { shown: 'W A S D Q E', label: 'move the head (Shift: finely)', group: 'Look around' }),
  row('s', mover(0, 0, -1)), row('a', mover(-1, 0, 0)), row('d', mover(1, 0, 0)), row('q', mover(0, -1, 0)), row('e', mover(0, 1, 0)),
];

// As openPicture() of picture.js.
export async function openLayered(panorama, item, form, address, { base, choice, signal, progress }) {
  const blob = await download(address, item.name, signal, progress);
  let picture;
  try {
    const { glb, about, meshes } = readScene(await blob.arrayBuffer());
    const film = about.film && (await import('./layered-film.js')).readFilm(glb, about.film, meshes);
    picture = new LayeredPicture(panorama, about, item);
    Object.assign(picture, { address, base, choice, camera: form.camera });
    await picture.fill(glb, meshes, film, { signal });
    return picture;
  } catch (error) {
    picture?.free();
    const isDamage = [SyntaxError, TypeError, RangeError].some((kind) => error instanceof kind);
    if (!isDamage && !(error instanceof Fault)) throw error;
    throw new Error(`${item.name} cannot be shown: ${isDamage ? 'it is damaged' : error.message}`);
  }
}
