// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in a stereo picture with depth (ods/view/picture_stage.h). Each eye's picture has a place of the
// eye for every direction, so the objects' vertices are seen from there, too: objects and picture agree wherever the head
// turns. The picture's distances hide what is behind them. Loaded with the first such picture, after objects.js.
//
// A stage gives a picture of picture.js what objects.js needs of a layered scene: about, draw() and more; its own
// cast() and rayOf() are for drags. Its frame is the camera's: x to the right, y up and z back, from the middle of the
// viewing circle.
import { FACES, dot, radians } from './geometry.js';
import { inverse, plus, scaled, turned } from './headset-room.js';
import { LayeredDrawer, NEAR } from './layered-draw.js';
import { Fault, check } from './meshopt.js';
import { Objects } from './objects.js';
import { ObjectsDrawer, partOf } from './objects-draw.js';
import { split } from './objects-split.js';
import { LIGHT, OBJECT, SHADOW } from './objects-shaders.js';
import { DECODE, GROUND, HIDE, MEET, STAGE_SHADE, STAGE_VERTICES } from './objects-stage-shaders.js';
import { decode, download } from './picture.js';

const CLOSE = 0.3; // metres from the middle of the viewing circle: nearer objects are not exact
const BIAS = 0.004; // metres below an object where its shadow begins: distances are those of texels
const MARGIN = 0.1; // metres around what an object may darken, for the eyes' places
const LACKS = ['planet', 'layout', 'projection'];
const MET = 10; // numbers that MEET returns
const UNITS = { merge_texels: 2, head_tilt_texels: 3, depths: 4 };

// The columns of a product of 3 x 3 matrices, by columns.
const product = (a, b) => [0, 3, 6].flatMap((k) => [0, 1, 2].map((i) => a[i] * b[k] + a[3 + i] * b[k + 1] + a[6 + i] * b[k + 2]));
const transposed = (m) => [0, 1, 2].flatMap((i) => [m[i], m[3 + i], m[6 + i]]);
const times = (m, v) => product(m, v).slice(0, 3);

class StageDrawer extends ObjectsDrawer {
  constructor(stage) {
    const { gl, picture: { drawer, panorama, camera } } = stage;
    super(gl, drawer, panorama.hasLight, {
      object: [OBJECT(HIDE(camera)), STAGE_VERTICES(camera, 2 * NEAR)], shade: [STAGE_SHADE(camera, SHADOW(BIAS))],
      light: [LIGHT(DECODE)], ground: [GROUND], meet: [MEET(camera)],
    });
    Object.assign(this, { stage, isCovered: true, lists: {} });
  }

  // As use(), with what the stage's shaders need. side: the eye.
  useStage(name, side) {
    const { stage, stage: { picture: { camera, mono, panorama }, info, depths } } = this;
    this.lists[name] ??= { program: this.programs[name].program, shaders: [] };
    const uniforms = panorama.use(this.lists[name]);
    panorama.bindMap(UNITS.merge_texels, camera.merge_map);
    panorama.bindMap(UNITS.head_tilt_texels, camera.head_tilt_map);
    this.bind(UNITS.depths, depths);
    const row = Math.min(side, info.eyes - 1);
    panorama.set(uniforms, {
      camera, ...UNITS, sides: Array(2).fill(mono ? 2 : side), coded: [Math.log2(info.nearest), 1 / info.per_octave], place: [row, info.eyes],
      center: info.center, frame: stage.frame,
    });
    return this.programs[name].at;
  }

  // Sets up the program of the objects for a view.
  begin({ toScreen, side }) {
    const at = this.useStage('object', side);
    this.gl.uniformMatrix3fv(at.to_screen, false, toScreen);
    return at;
  }

  // Shows the picture of an eye, a texture of codes, below the objects.
  ground(texture) {
    const { gl } = this;
    const at = this.use('ground');
    gl.disable(gl.DEPTH_TEST);
    this.bind(0, texture);
    gl.uniform1i(at.page, 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  shade(objects, view) {
    const { gl, stage } = this;
    const { rays, toScreen, part, side } = view;
    const at = this.useStage('shade', side);
    for (const [unit, name] of ['page', 'from_sun', 'from_above'].entries()) gl.uniform1i(at[name], unit === 0 ? 0 : unit + 4);
    gl.uniformMatrix3fv(at.rays, false, rays);
    gl.uniform2fv(at.view, view.size);
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.ZERO, gl.SRC_COLOR, gl.ZERO, gl.ONE);
    const fromWorld = { ...view, toScreen: product(toScreen, transposed(stage.frame)), at: stage.info.center };
    for (const object of objects) {
      const own = partOf(object.within.map((corner, k) => corner.map((value) => value + (2 * k - 1) * MARGIN)), fromWorld);
      if (own[2] === 0 || own[3] === 0) continue;
      gl.scissor(...own);
      this.setShade(object, at);
      this.bind(0, view.page);
      this.bind(5, object.maps[0]);
      this.bind(6, object.maps[1]);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    gl.scissor(...part);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
  }

  // The triangles below an object: there are none.
  list(object) {
    object.within = this.within(object);
  }

  drawAround(rays, size) {
    const { stage, small } = this;
    stage.panorama.drawOne(stage.picture, { rays: product(transposed(stage.frame), rays), box: [0, 0, size, size], moves: true, target: small.eyes[0].target });
  }
}

export class Stage {
  // item: of view.json, with a stage. depths: a decoded picture.
  constructor(picture, panorama, item, { base, choice }, depths) {
    const { gl } = panorama;
    const { stage: info } = item;
    Object.assign(this, { picture, panorama, gl, item, info, choice, frame: info.frame.flat(), target: gl.createFramebuffer(), heard: new AbortController() });
    this.depths = this.upload(depths);
    this.light = { exposure: 1, neutral: false, probes: { origin: [0, 0, 0], step: [1, 1, 1], count: [1, 1, 1], values: Float32Array.from([1, ...info.light]) } };
    this.develop();
    const { free } = picture;
    Object.assign(picture, {
      item, base, panorama, gl, stage: this, heard: this.heard, meshes: [], actions: [], lacks: LACKS, drawer: new LayeredDrawer(gl),
      about: { center: info.center, turn: radians(info.yaw) },
      draw: (by, options) => this.draw(options),
      refresh: () => this.refresh(),
      free: () => {
        this.free();
        free();
      },
    });
  }

  upload(source) {
    const { gl } = this;
    check(Math.max(source.width, source.height) <= gl.getParameter(gl.MAX_TEXTURE_SIZE), 'this GPU cannot hold its distances');
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, source);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    return texture;
  }

  makeDrawer() {
    return new StageDrawer(this);
  }

  // Divides what is too large for the shifts of its vertices.
  prepare(file) {
    file.parts.forEach(split);
  }

  // A line if an object is too near, else nothing.
  faultOf({ info: { name }, file: { low, high }, matrix }) {
    const away = plus(this.info.center, matrix.slice(12, 15), -1);
    const own = [0, 4, 8].map((k) => dot(matrix.slice(k, k + 3), away));
    const nearest = Math.hypot(...own.map((value, i) => Math.max(low[i] - value, value - high[i], 0)));
    return nearest < CLOSE ? `${name} is ${nearest.toFixed(2)} m from the viewer, where it is not exact: ${CLOSE} m are needed` : '';
  }

  // Takes over exposure and tone curve; returns whether they have changed.
  develop() {
    const { picture, item, choice: { exposure = item.exposure ?? 0, tone = item.tone }, light } = this;
    const now = { exposure: 2 ** (picture.light ? picture.stops : item.live ? exposure : 0), neutral: Boolean(item.live) && (picture.tone ?? tone) !== 'linear' };
    const is = now.exposure !== light.exposure || now.neutral !== light.neutral;
    Object.assign(light, now);
    return is;
  }

  refresh() {
    const { objects } = this.picture;
    if (!objects) return;
    if (this.develop()) {
      for (const object of objects.all) {
        objects.lit(object);
        object.mirrored = null;
      }
    }
    objects.refresh();
  }

  draw(options) {
    const { picture, panorama, picture: { objects, drawer } } = this;
    const { rays, box, clip = box, show = 'eye', eye = 0, swap = false, target = null, shift = 0, all, planet } = options;
    if (!objects?.all.length || all || planet) return panorama.drawOne(picture, options);
    objects.prepare();
    drawer.fit(box.slice(2));
    this.fit(drawer.size);
    const part = [clip[0] - box[0], clip[1] - box[1], clip[2], clip[3]];
    for (const [i, shown] of (show === 'eye' ? [eye] : [0, 1]).entries()) {
      const side = swap ? 1 - shown : shown;
      panorama.drawOne(picture, { ...options, show: 'eye', eye: shown, box: [0, 0, ...box.slice(2)], clip: part, target: this.target });
      const turn = picture.mono ? 0 : shown ? -shift : shift;
      const own = [0, 3, 6].flatMap((at) => turned(rays.slice(at, at + 3), turn));
      const draw = (view) => {
        objects.drawer.ground(this.page);
        objects.draw({ ...view, rays: own, side, page: this.page });
      };
      drawer.drawEye(i, [], { rays: own, at: [0, 0, 0], middle: [0, 0, 0], part, objects: { draw } });
    }
    drawer.showEyes({ box, clip, target, show: ['eye', 'anaglyph', 'difference'].indexOf(show), cover: 1, grey: 0 });
  }

  // A texture for the picture of an eye, as the page shows it.
  fit([width, height]) {
    const { gl } = this;
    if (this.size?.[0] === width && this.size[1] === height) return;
    gl.deleteTexture(this.page ?? null);
    Object.assign(this, { size: [width, height], page: this.plain(width, height, this.target) });
  }

  // A texture of 8 bits that is drawn into.
  plain(width, height, target) {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    return texture;
  }

  // --- drags -------------------------------------------------------------------------------------------------------------

  // The surface that an eye sees in a direction of the frame: { found, at, from, normal } in the world.
  meet(direction, side) {
    const { gl } = this;
    const { drawer } = this.picture.objects;
    this.metTarget ??= gl.createFramebuffer();
    this.met ??= this.plain(MET, 1, this.metTarget);
    const at = drawer.useStage('meet', side);
    gl.uniform3fv(at.along, direction);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.metTarget);
    gl.viewport(0, 0, MET, 1);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const bytes = new Uint8Array(4 * MET);
    gl.readPixels(0, 0, MET, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const numbers = new Float32Array(bytes.buffer);
    const [place, from, normal] = [0, 3, 6].map((k) => [...numbers.subarray(k, k + 3)]);
    return { found: numbers[9] > 0, at: place, from, normal };
  }

  // The ray of an eye in a direction of the page: { from, along }.
  rayOf(direction, side, shift) {
    const along = scaled(turned(direction, side ? -shift : shift), 1);
    this.side = side;
    return { from: this.meet(along, side).from, along: times(this.frame, along) };
  }

  // As Surfaces.cast(), for the eye of the last rayOf().
  cast(from, along) {
    const { found, at, normal } = this.meet(times(transposed(this.frame), along), this.side);
    return found ? { at, normal, distance: Math.hypot(...plus(at, from, -1)) } : null;
  }

  free() {
    const { gl, picture: { objects, drawer } } = this;
    this.heard.abort();
    objects?.free();
    drawer.free();
    for (const texture of [this.depths, this.page, this.met]) gl.deleteTexture(texture ?? null);
    for (const target of [this.target, this.metTarget]) gl.deleteFramebuffer(target ?? null);
  }
}

// Makes a picture the stage of its item's objects.
async function setStage(picture, panorama, item, how) {
  const blob = await download(new URL(item.stage.depth, how.base ?? location.href), item.name, how.signal);
  const depths = await decode(blob, item.name, 'none');
  try {
    if (!how.signal?.aborted) return new Stage(picture, panorama, item, how, depths);
  } catch (error) {
    if (!(error instanceof Fault)) throw error;
    throw new Error(`The objects in ${item.name} cannot be shown: ${error.message}`);
  } finally {
    depths.close();
  }
}

// Shows the objects of a picture's item in it, unless another picture is shown by then. how: of openPicture().
export async function enterStage(picture, viewer, panorama, item, how) {
  if (viewer.picture === picture) await setStage(picture, panorama, item, how);
  if (viewer.picture !== picture || !picture.stage) return;
  picture.objects = new Objects(picture, viewer);
  await picture.objects.load();
}
