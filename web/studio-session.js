// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio's connection to the server: it sends settings and receives frames. Two sides, A and B, each with its own
// settings and history; the server renders the active one, or the other for a while (refine). Events: `edit` (the
// settings, the history or the active side), `accepted` (detail: its side), `refused` (detail: { text, paths }),
// `status` (detail: the data of a frame or the server; isOthers: another tab has changed the settings), `lost` and
// `found` (the server).
const PAUSE = 30; // milliseconds between two messages
const PATIENCE = 400; // milliseconds that a drag waits for a picture of its last message, so that one appears at all
const HISTORY = 200;

export const ENDED = 'ods view has ended. Start it again, and this page continues by itself.';

export const sleep = (time) => new Promise((done) => setTimeout(done, time));
const copy = (value) => structuredClone(value);
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export const valueAt = (settings, path) => path.split('.').reduce((from, key) => from?.[key], settings);

function put(settings, path, value) {
  const keys = path.split('.');
  const last = keys.pop();
  const parent = keys.reduce((from, key) => (from[key] ??= {}), settings);
  if (value === undefined) delete parent[last];
  else parent[last] = value;
}

// The settings for which the server opens the scene again, and counts its frames from 1.
const REOPENS = /^(env|sun|turn|strength|variant)/;

// The paths where two settings differ.
function changes(a, b, at = '') {
  if (same(a, b)) return [];
  if (typeof a !== 'object' || typeof b !== 'object' || !a || !b) return [at];
  return [...new Set([...Object.keys(a), ...Object.keys(b)])].flatMap((key) => changes(a[key], b[key], at ? `${at}.${key}` : key));
}

// Sends JSON, or a file unchanged. Throws an Error with the server's line of text; its `refused` is set if the server
// understood the request but rejects it.
export async function ask(path, body) {
  const options = body === undefined ? {} : { method: 'POST', body: body instanceof Blob ? body : JSON.stringify(body) };
  const answer = await fetch(`studio/${path}`, options).catch(() => {
    throw new Error(ENDED);
  });
  if (answer.ok) return answer.json();
  const text = (await answer.text()).trim().split('\n')[0];
  throw Object.assign(new Error(text || `The server answers ${answer.status}`), { refused: answer.status < 500 });
}

export class Session extends EventTarget {
  // look(): { yaw, pitch, fov, aspect } of the view. onFrame(meta, pixels, side): displays it, may be async.
  constructor(settings, look, onFrame) {
    super();
    Object.assign(this, { look, onFrame, revision: 0, number: 0, alive: true, wanted: false, eager: true, sentAt: 0, shown: 0, epoch: 0 });
    this.sides = [{ settings: copy(settings), past: [], future: [] }];
    this.active = 0;
    this.target = 0; // index of the rendered side
  }

  // Returns whether the page is visible.
  isSeen() {
    return true;
  }

  start() {
    this.send(true);
    this.receive();
  }

  get side() {
    return this.sides[this.active];
  }

  get settings() {
    return this.side.settings;
  }

  say(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  // Changes values by their paths; undefined removes one. Edits with the same gesture (not null) are one undo step;
  // `dragging` announces further edits at once.
  edit(values, gesture = null, dragging = false) {
    const { side } = this;
    const next = copy(side.settings);
    for (const [path, value] of Object.entries(values)) put(next, path, value);
    if (same(next, side.settings)) {
      if (!dragging && !this.eager) this.send(true);
      return;
    }
    if (gesture === null || gesture !== this.gesture) {
      side.past.push(side.settings);
      if (side.past.length > HISTORY) side.past.shift();
      side.future = [];
    }
    this.gesture = gesture;
    this.use(next, !dragging);
  }

  use(settings, eager = true) {
    this.side.settings = settings;
    this.say('edit');
    this.send(eager);
  }

  // by: -1 undoes, 1 redoes.
  step(by) {
    const [from, to] = by < 0 ? [this.side.past, this.side.future] : [this.side.future, this.side.past];
    if (!from.length) return false;
    to.push(this.settings);
    this.gesture = null;
    this.use(from.pop());
    return true;
  }

  // Switches to the other side, which starts as a copy of this one.
  swap(to = 1 - this.active) {
    if (to === this.active) return;
    this.sides[to] ??= { settings: copy(this.settings), past: [], future: [] };
    this.active = to;
    this.gesture = null;
    this.say('edit');
    this.send(true);
  }

  // Has the other side rendered, until something changes.
  refine(side) {
    this.send(true, side);
  }

  // Waits until the server renders the present settings of the active side. Throws its rejection.
  async settle(patience = 5000) {
    const { side } = this;
    if (this.target !== this.active || this.isOthers) this.send(true);
    const end = performance.now() + patience;
    while ((this.sending || this.wanted) && performance.now() < end) await sleep(10);
    if (side.sent !== side.settings) throw new Error(this.fault || ENDED);
  }

  // Replaces the settings by those of the server, as after a drop.
  replace(settings) {
    this.side.past.push(this.settings);
    this.side.future = [];
    this.use(copy(settings));
  }

  async send(eager, target = this.active) {
    Object.assign(this, { wanted: true, eager, target });
    if (this.sending) return;
    this.sending = true;
    while (this.wanted) {
      while (this.mustWait()) await sleep(8);
      this.wanted = false;
      const side = this.sides[this.target];
      const { settings } = side;
      this.sentAt = performance.now();
      this.answer = ask('set', { ...settings, look: this.look() });
      try {
        const { revision, command, note, end } = await this.answer;
        const isReopened = changes(this.sent ?? settings, settings).some((path) => REOPENS.test(path));
        if (revision < this.revision || isReopened) this.restart();
        Object.assign(this, { revision, sent: settings, isOthers: false });
        Object.assign(side, { revision, command, note, end, sent: settings });
        this.fault = '';
        if (this.missed) this.fromStart();
        this.say('accepted', side);
      } catch (error) {
        if (error.refused) {
          this.fault = error.message;
          this.say('refused', { text: error.message, paths: changes(side.sent ?? settings, settings) });
        } else {
          this.lose();
          await sleep(1000);
          this.wanted = true;
        }
      }
    }
    this.sending = false;
  }

  mustWait() {
    const since = performance.now() - this.sentAt;
    return since < PAUSE || (!this.eager && since < PATIENCE && this.shown < this.revision);
  }

  lose() {
    if (!this.alive) return;
    this.alive = false;
    this.say('lost');
  }

  // Requests the latest frames again.
  fromStart() {
    Object.assign(this, { number: 0, missed: false });
    this.request?.abort();
  }

  // The numbers of the server start again: it has opened the scene again, or was restarted.
  restart() {
    Object.assign(this, { epoch: this.epoch + 1, revision: 0, shown: 0 });
    this.fromStart();
    for (const side of this.sides) if (side) side.revision = undefined;
    this.say('restart');
  }

  find() {
    this.alive = true;
    this.restart();
    this.say('found');
    this.send(true);
  }

  async receive() {
    for (;;) {
      try {
        while (!this.isSeen()) await sleep(300); // the server pauses without requests
        const { epoch } = this;
        this.request = new AbortController();
        const answer = await fetch(`studio/frame?after=${this.number}`, { signal: this.request.signal });
        if (!answer.ok) {
          this.say('status', { fault: (await answer.text()).trim() });
          await sleep(1000);
        } else {
          if (!this.alive) this.find();
          else if (answer.status === 200 && epoch === this.epoch) await this.show(await answer.arrayBuffer(), epoch);
        }
      } catch (error) {
        if (error.name === 'AbortError') continue;
        if (error.name === 'FrameError') console.warn(error.message);
        else this.lose();
        await sleep(1000);
      }
    }
  }

  async show(buffer, epoch) {
    const length = new DataView(buffer).getUint32(0, true);
    const meta = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    this.number = meta.number;
    await this.answer?.catch(() => {}); // it may report that this frame is outdated
    if (epoch !== this.epoch) return;
    const side = this.sides[this.target];
    if (meta.revision !== side.revision) {
      const isAhead = meta.revision > this.revision;
      this.missed ||= isAhead; // the frame arrived before the answer with its number
      if (isAhead && !this.sending) {
        this.isOthers = true;
        this.say('status', { isOthers: true });
      }
      return;
    }
    this.shown = meta.revision;
    const pixels = new Uint8Array(buffer, 4 + length);
    try {
      await this.onFrame(meta, pixels, side);
    } catch (error) {
      throw Object.assign(error, { name: 'FrameError' });
    }
    this.say('status', { ...meta, side });
  }
}
