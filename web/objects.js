// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in a layered scene, or in a picture that is a stage (objects-panorama.js): their places, which keys
// and drags change and the server keeps, their animation and their light. Loaded with the first one that has some: an item's `objects`, of view.json, each
//   { file: its address, name, path: of its file for commands, if it is not the name, at: metres, turn: degrees }
// Places are in the scene's axes; it turns counter-clockwise as seen from above.
import { clamp, radians } from './geometry.js';
import { plus, turned } from './headset-room.js';
import { textureOf } from './layered.js';
import { Fault } from './meshopt.js';
import { readObject, transformed } from './objects-file.js';
import { Hands } from './objects-hands.js';
import { lightAt, readLight, sunOf, termsOf } from './objects-light.js';
import { ObjectsDrawer } from './objects-draw.js';
import { ObjectsPanel } from './objects-panel.js';
import { Surfaces } from './objects-surface.js';
import { download } from './picture.js';

const FAR = 1000; // metres: no place is farther
const STEP = 0.05; // metres of a key
const FINE = 0.005;
const TURN = 15; // degrees of a key
const REST = 250; // milliseconds without a change until what is reflected is drawn, and the place is saved
const SLOW = 100; // milliseconds: time that passes in a pause does not count

const round = (value, digits) => Math.round(value * 10 ** digits) / 10 ** digits + 0; // no -0
const wrapped = (angle) => ((angle % 360) + 360) % 360;
// A text as a shell needs it.
const quoted = (text) => (/^[\w.,/:=+%@-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

export class Objects {
  // read: of a layered scene's file: { glb, meshes }, as layered.js has read them.
  constructor(picture, viewer, read) {
    Object.assign(this, { picture, viewer, all: [], chosen: null, past: [], isStill: matchMedia('(prefers-reduced-motion: reduce)').matches });
    this.panel = new ObjectsPanel(this);
    viewer.panorama.canvas.addEventListener('webglcontextlost', () => this.free(), { once: true, signal: picture.heard.signal }); // the next picture has its own
    if (picture.stage) Object.assign(this, { surfaces: picture.stage, light: picture.stage.light });
    else this.read(read);
  }

  read({ glb, meshes }) {
    const { picture } = this;
    const isSolid = ({ isSky, isBlended, lights }) => !isSky && !isBlended && !lights;
    this.solid = picture.meshes.filter(isSolid);
    this.surfaces = new Surfaces(meshes.filter((_, i) => isSolid(picture.meshes[i]))); // in the same order
    picture.read = null; // as large as the file
    try {
      this.light = readLight(glb);
    } catch (error) {
      this.light = { exposure: 1, neutral: true, probes: null };
      this.complain(`The light of ${picture.item.name} cannot be used: ${error instanceof Fault ? error.message : 'it is damaged'}`);
    }
  }

  complain(words) {
    console.warn(words);
    this.panel.complain(words);
  }

  async load() {
    const { picture, picture: { gl, drawer, panorama, item, heard: { signal } } } = this;
    this.drawer = picture.stage?.makeDrawer() ?? new ObjectsDrawer(gl, drawer, panorama.hasLight);
    for (const info of item.objects) {
      try {
        await this.open(info, signal);
      } catch (error) {
        if (signal.aborted || this.isFree) return;
        const isDamage = [SyntaxError, TypeError, RangeError].some((kind) => error instanceof kind);
        this.complain(isDamage || error instanceof Fault ? `${info.name} cannot be shown: ${isDamage ? 'it is damaged' : error.message}` : error.message);
      }
    }
    if (signal.aborted || this.isFree) return;
    picture.actions = [...OBJECT_KEYS, ...picture.actions];
    this.hands = new Hands(this);
    this.panel.update();
    picture.changed?.();
  }

  async open(info, signal) {
    const { picture, picture: { gl, base } } = this;
    const blob = await download(new URL(info.file, base ?? location.href), info.name, signal);
    const file = readObject(await blob.arrayBuffer());
    const numbers = [...new Set(file.parts.map(({ material: { image } }) => image).filter((image) => image !== undefined))];
    const sources = await Promise.all(numbers.map((image) => createImageBitmap(file.glb.image(image), { premultiplyAlpha: 'none' }).catch(() => {
      throw new Fault('this browser does not read its textures');
    })));
    if (signal.aborted || this.isFree) return sources.forEach((source) => source.close());
    const textures = new Map(numbers.map((image, i) => [image, textureOf(gl, sources[i], { levels: 16, wrap: gl.REPEAT })]));
    sources.forEach((source) => source.close());
    picture.stage?.prepare(file);
    const { low, high } = file;
    const size = Math.max(Math.hypot(...plus(high, low, -1)) / 2, 0.01) * 1.01;
    const object = {
      info, file, radius: size, time: 0, pose: { frame: 0, next: 0, part: 0 },
      reach: [clamp(6 * size, 0.5, 4), clamp(size, 0.05, 0.6)],
    };
    this.drawer.upload(object, textures);
    file.glb = null; // its bytes are on the GPU
    this.all.push(object);
    const [at, turn] = [info.at, info.turn].map((value) => value ?? 0);
    this.put(object, { at: Array.isArray(at) ? at : [0, 0, 0], turn });
    object.isCalm = true;
  }

  // --- places ----------------------------------------------------------------------------------------------------------

  put(object, { at = object.at, turn = object.turn }) {
    object.at = at.map((value) => round(clamp(value, -FAR, FAR), 3));
    object.turn = round(wrapped(turn), 1);
    const angle = radians(object.turn);
    const [s, c] = [Math.sin(angle), Math.cos(angle)];
    object.matrix = [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, ...object.at, 1];
    const { low, high } = object.file;
    object.middle = transformed(object.matrix, low.map((value, i) => (value + high[i]) / 2));
    this.lit(object);
    object.isCast = object.isCalm = false;
    const fault = this.picture.stage?.faultOf(object);
    if (fault) this.complain(fault);
  }

  lit(object) {
    const light = lightAt(this.light, object.middle);
    const { exposure, neutral } = this.light;
    const sun = sunOf(light);
    object.light = { sun, exposure, neutral, terms: termsOf(light, true), around: termsOf(light, false) };
    // The less light comes from one side, the wider it is.
    const [direct, all] = [sun.sun, sun.ambient].map((list) => list.reduce((sum, value) => sum + value, 0));
    object.spread = [0.06 + (0.5 * all) / (direct + all), 0.8];
  }

  // Places that users give: with a way back, and saved. isGoing: of a drag, whose beginning is the way back.
  move(object, place, isGoing = false) {
    if (!isGoing) this.past.push({ object, at: object.at, turn: object.turn });
    this.put(object, place);
    Object.assign(object.info, { at: object.at, turn: object.turn });
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.rest(), REST);
    this.viewer.redraw();
    this.panel.update();
  }

  rest() {
    this.resting = null;
    this.all.forEach((object) => (object.isCalm = true));
    this.viewer.redraw();
    this.save();
  }

  undo() {
    const last = this.past.pop();
    if (!last) return;
    this.move(last.object, last, true);
  }

  // Only ods view keeps places; where a file was unreadable, its place stays.
  async save() {
    const { viewer: { view }, picture: { item } } = this;
    if (!view.live) return;
    const body = JSON.stringify({ objects: item.objects.map(({ name, at, turn }) => ({ name, at, turn })) });
    try {
      const answer = await fetch(`objects?item=${view.items.indexOf(item)}`, { method: 'POST', body, keepalive: true });
      this.panel.complain(answer.ok ? '' : `The places are not saved: ${(await answer.text()).trim().split('\n')[0]}`);
    } catch {
      this.panel.complain('The places are not saved: ods view has ended');
    }
  }

  // The parts of the command that renders this, an option each.
  command() {
    const { item, about: { center, turn } } = this.picture;
    const { camera, stage } = this.picture;
    const scene = item.scene ?? (stage ? 'SCENE' : item.name);
    const apart = stage && Math.abs(camera.ipd - 0.065) > 1e-5;
    const place = (list) => list.map((value) => round(value, 3)).join();
    const yaw = round((turn * 180) / Math.PI, 2);
    return [
      `ods render ${quoted(scene)}`, `--position ${place(center)}`, ...(yaw ? [`--yaw ${yaw}`] : []), ...(apart ? [`--ipd ${round(camera.ipd, 5)}`] : []),
      ...item.objects.flatMap(({ name, path, at, turn: own }) => [`--with ${quoted(path ?? name)}`, `--at ${place(at)}`, ...(own ? [`--turn ${own}`] : [])]),
      `-o ${quoted(`${(stage ? 'with' : scene).replace(/^.*[/\\]/, '').replace(/\.\w+$/, '')}_360_TB.png`)}`,
    ];
  }

  choose(object) {
    if (object === this.chosen) return;
    this.chosen = object;
    this.panel.update();
    this.viewer.say('change');
  }

  // Along the axes of the present view: to its right, up, ahead.
  step(right, up, ahead) {
    const { chosen, viewer: { state }, picture: { about } } = this;
    if (chosen) this.move(chosen, { at: plus(chosen.at, turned([right, up, -ahead], radians(state.yaw) + about.turn)) });
  }

  turnBy(angle) {
    if (this.chosen) this.move(this.chosen, { turn: this.chosen.turn + angle });
  }

  // --- pictures ----------------------------------------------------------------------------------------------------------

  get isMoving() {
    return !this.isStill && this.all.some(({ file }) => file.frames > 1);
  }

  // Before every picture: what moves does, and asks for the next one.
  refresh() {
    const now = performance.now();
    const passed = Math.min(now - (this.last ?? now), SLOW) / 1000;
    this.last = now;
    if (!this.isMoving) return;
    for (const object of this.all) {
      const { frames, rate } = object.file;
      if (frames < 2) continue;
      object.time = (object.time + passed * rate) % frames;
      const frame = Math.floor(object.time);
      object.pose = { frame, next: (frame + 1) % frames, part: object.time - frame };
      object.isCast = false;
    }
    if (!this.viewer.session) this.viewer.redraw();
  }

  // Brings the maps of shadows and reflections up to date.
  prepare() {
    const { drawer, all, solid, surfaces, picture: { meshes, about } } = this;
    for (const object of all) {
      if (!object.isCast) drawer.cast(object, surfaces, solid);
      object.isCast = true;
      if (object.isCalm && object.mirrored !== object.matrix) {
        drawer.reflect(object, meshes, about.center);
        object.mirrored = object.matrix;
      }
    }
  }

  // In a view of an eye (layered-draw.js).
  draw(view) {
    if (this.all.length) this.drawer.draw(this.all, view);
  }

  free() {
    this.isFree = true;
    if (this.resting) {
      clearTimeout(this.resting);
      this.save();
    }
    this.hands?.free();
    this.panel.free();
    this.all.forEach((object) => this.drawer.freeObject(object));
    this.drawer?.free();
  }
}

const GROUP = 'Objects';
const of = (run) => (player, { picture: { objects } }) => run(objects);
const isChosen = ({ picture }) => Boolean(picture?.objects?.chosen);
const row = (id, keys, run, more = {}) => ({ id: `object-${id}`, keys, run: of(run), group: GROUP, when: isChosen, ...more });
const stepper = (id, key, way, more) => row(id, [key], (objects) => objects.step(...way.map((part) => part * STEP)), {
  fine: of((objects) => objects.step(...way.map((part) => part * FINE))), ...more,
});
const turner = (id, key, way, more) => row(id, [key], (objects) => objects.turnBy(way * TURN), { fine: of((objects) => objects.turnBy(way)), ...more });

// The next object, after the last one none. Returns its name.
function chooseNext(objects) {
  const { all, chosen } = objects;
  objects.choose(all[all.indexOf(chosen) + 1] ?? null);
  return objects.chosen?.info.name ?? '';
}

// The keys of objects (actions.js).
export const OBJECT_KEYS = [
  row('next', ['b'], chooseNext, { label: 'choose an object, which keys then move', when: ({ picture }) => picture?.objects?.all.length > 0 }),
  stepper('left', 'ArrowLeft', [-1, 0, 0], { shown: '← → ↑ ↓', label: 'move the object (Shift: finely)' }),
  stepper('right', 'ArrowRight', [1, 0, 0]), stepper('away', 'ArrowUp', [0, 0, 1]), stepper('near', 'ArrowDown', [0, 0, -1]),
  stepper('up', 'PageUp', [0, 1, 0], { shown: 'PageUp PageDown', label: 'raise, lower the object (Shift: finely)' }),
  stepper('down', 'PageDown', [0, -1, 0]),
  turner('turn', 'j', 1, { shown: 'J K', label: 'turn the object (Shift: finely)' }), turner('turn-right', 'k', -1),
  row('leave', ['Escape'], (objects) => objects.choose(null)),
  row('undo', ['z'], (objects) => objects.undo(), { label: 'the object’s last place', when: ({ picture }) => picture?.objects?.past.length > 0 }),
  row('play', [' '], (objects) => {
    objects.isStill = !objects.isStill;
    objects.viewer.redraw();
  }, { shown: 'Space', label: 'play, pause', when: ({ picture }) => picture?.objects?.all.some(({ file }) => file.frames > 1) }),
];
