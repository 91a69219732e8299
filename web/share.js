// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The state that the pages of one server share while a headset is worn: the item and its view. The desk sees the
// wearer's view, and the wearer sees the point that the desk marks. Each page sends its whole state, and of each field
// the latest change of any page counts; so a lost message has no lasting effect.
//
// Changes are counted on a ring, as in RFC 1982: whatever number another page claims, the next one is newer. Values
// that do not have the form that pages give them are dropped.
import { wrapDegrees } from './geometry.js';
import { WORN } from './modes.js';
import { directionAt } from './places.js';

const TICK = 100; // milliseconds
const SPEAK = 2000; // maximum time between messages
const GONE = 6000; // time without a message after which a page is gone
const APART = 0.7; // maximum difference of seconds between playing videos

const RING = 2 ** 32;
const isClock = (clock) => Number.isInteger(clock) && clock >= 0 && clock < RING;
const nextClock = (clock) => (clock + 1 < RING ? clock + 1 : 1); // 0: unchanged
const isNewer = (a, b) => a !== 0 && a !== b && (b === 0 || (a - b + RING) % RING < RING / 2);

const isNumber = (value) => typeof value === 'number' && Math.abs(value) <= 1e6;
const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);
const isLook = (look) => isObject(look) && ['yaw', 'pitch', 'roll'].every((name) => isNumber(look[name])) && ['x', 'y', 'z'].every((name) => isNumber(look[name] ?? 0));
const isPoint = (point) => isObject(point) && isNumber(point.yaw) && isNumber(point.pitch);
// The same members, each of the same type where both have one.
const isLike = (value, model) =>
  isObject(model) ? isObject(value) && Object.keys(model).every((key) => (model[key] ?? value[key] ?? null) === null || isLike(value[key], model[key]))
  : (model ?? value ?? null) === null || (typeof value === typeof model && Array.isArray(value) === Array.isArray(model));

const sleep = (time) => new Promise((done) => setTimeout(done, time));
const round = (look) => Object.fromEntries(Object.entries(look).map(([name, value]) => [name, typeof value === 'number' ? Math.round(1000 * value) / 1000 : value]));

// Each field with its present value, undefined if there is none, whether another page's value has its form, and a
// function that applies that value.
const FIELDS = {
  shown: {
    of: ({ viewer: { item, choice } }) => ({ item, choice }),
    fits: (value) => isObject(value) && Number.isInteger(value.item) && isNumber(value.item) && isObject(value.choice ?? {}),
    async take({ viewer }, { item, choice }) {
      if (item < 0) return viewer.studio?.showScene();
      if (!viewer.view.items[item]) viewer.view.items = (await (await fetch('view.json')).json()).items; // rendered since
      return viewer.view.items[item] && viewer.open(item, choice);
    },
  },
  swap: { of: ({ viewer }) => viewer.state.swap, fits: (swap) => typeof swap === 'boolean', take: ({ viewer }, swap) => viewer.set({ swap }) },
  worn: { of: ({ viewer }) => viewer.state.worn ?? 'stereo', fits: (worn) => WORN.some(({ name }) => name === worn), take: ({ viewer }, worn) => viewer.set({ worn }) },
  film: {
    of: (share) => share.film(),
    fits: (film) => isObject(film) && Number.isInteger(film.item) && typeof film.playing === 'boolean' && isNumber(film.at),
    take: (share, film, time) => share.play(film, time),
  },
  settings: {
    of: ({ viewer }) => viewer.studio?.session.settings,
    fits: (settings, { viewer }) => isLike(settings, viewer.studio?.session.settings ?? {}),
    take: ({ viewer }, settings) => viewer.studio?.session.use(settings),
  },
};

export class Share {
  constructor(player) {
    const { viewer } = player;
    Object.assign(this, { player, viewer, id: Math.random().toString(36).slice(2, 12), clock: 0, known: {}, number: 0, spoke: 0, others: {} });
    Object.assign(this, { follows: true, reel: {}, point: null, heard: new AbortController() });
    const on = (event, run) => viewer.element.addEventListener(event, run, { signal: this.heard.signal });
    on('pointerdown', () => this.follow(false));
    on('pointermove', ({ offsetX, offsetY }) => (this.point = directionAt(viewer, offsetX, offsetY)));
    on('pointerleave', () => (this.point = null));
    // Pages that join later take the wearer's state.
    for (const name of Object.keys(FIELDS)) this.note(name, viewer.session ? 1 : 0);
    this.timer = setInterval(() => this.tick(), TICK);
    this.listen();
  }

  end() {
    clearInterval(this.timer);
    this.heard.abort();
    this.button?.remove();
  }

  note(name, clock, by = this.id) {
    const value = FIELDS[name].of(this);
    if (value === undefined) return;
    if (isNewer(clock, this.clock)) this.clock = clock;
    this.known[name] = { value, text: JSON.stringify(value), clock, by };
  }

  // --- sending ---

  tick() {
    for (const name of Object.keys(FIELDS)) {
      const value = FIELDS[name].of(this);
      const known = this.known[name];
      if (value !== undefined && JSON.stringify(value) !== known?.text) this.note(name, known || name !== 'film' ? nextClock(this.clock) : 0);
    }
    const { viewer: { session, state }, known, point } = this;
    const fields = Object.fromEntries(Object.entries(known).map(([name, { value, clock, by }]) => [name, { value, clock, by }]));
    const look = session ? round({ yaw: state.yaw, pitch: state.pitch, roll: state.roll, x: state.x, y: state.y, z: state.z }) : undefined;
    const text = JSON.stringify({ fields, look, point: session || !point ? undefined : round(point) });
    const now = performance.now();
    this.forget(now);
    const isHeard = Object.keys(this.others).length > 0;
    if (this.speaking || ((text === this.said || !isHeard) && now - this.spoke < SPEAK)) return;
    Object.assign(this, { said: text, spoke: now, speaking: true });
    const body = JSON.stringify({ ...JSON.parse(text), time: this.viewer.picture?.video?.currentTime });
    fetch(`share?id=${this.id}`, { method: 'POST', body }).catch(() => {}).finally(() => (this.speaking = false));
  }

  // The video's state since its last change; a page that has just opened one has no state of it yet.
  film() {
    const { viewer: { picture, item }, reel } = this;
    if (!picture?.video) return undefined;
    const { video, fps } = picture;
    const now = performance.now() / 1000;
    const expected = reel.time + (video.paused ? 0 : (now - reel.now) * video.playbackRate);
    if (reel.picture !== picture) delete this.known.film;
    if (reel.picture !== picture || reel.film.playing === video.paused || Math.abs(video.currentTime - expected) > (video.paused ? 0.5 / fps : APART / 2)) {
      reel.film = { item, playing: !video.paused, at: Math.round(1000 * video.currentTime) / 1000 };
    }
    Object.assign(reel, { picture, now, time: video.currentTime });
    return reel.film;
  }

  play(film, time = film.at) {
    const { viewer: { picture, item, session }, reel } = this;
    if (!picture?.video || film.item !== item) return;
    const { video, fps } = picture;
    if (Math.abs(video.currentTime - time) > (film.playing ? APART : 0.5 / fps)) picture.seek(time);
    if (film.playing === video.paused) {
      if (film.playing && !session) video.muted = true; // otherwise the browser waits for a click
      picture.toggle();
    }
    Object.assign(reel, { film, now: performance.now() / 1000, time: video.currentTime });
  }

  // --- receiving ---

  async listen() {
    while (!this.heard.signal.aborted) {
      try {
        const answer = await fetch(`share?id=${this.id}&after=${this.number}`, { signal: this.heard.signal });
        const { number, messages } = await answer.json();
        this.number = number;
        for (const [id, message] of Object.entries(messages)) if (isObject(message)) this.take(id, message);
        await sleep(TICK / 2);
      } catch {
        this.number = 0; // the server may have been restarted
        await sleep(1000);
      }
    }
  }

  take(id, message) {
    const time = isNumber(message.time) ? message.time : undefined;
    for (const [name, field] of Object.entries(FIELDS)) {
      const { value, clock, by } = message.fields?.[name] ?? {};
      if (isClock(clock) && typeof by === 'string' && field.fits(value, this)) this.takeField(name, value, clock, by, time);
    }
    const look = isLook(message.look) ? message.look : undefined;
    const point = isPoint(message.point) ? message.point : undefined;
    if (JSON.stringify(point) !== JSON.stringify(this.others[id]?.point)) this.player.headset?.mark(point ?? null);
    this.others[id] = { look, point, at: performance.now() };
    if (look && !this.viewer.session) this.watch(look);
  }

  takeField(name, value, clock, by, time) {
    const known = this.known[name];
    if (known && !isNewer(clock, known.clock) && (clock !== known.clock || by <= known.by)) return;
    if (name === 'film' && this.film()?.item !== value.item) return;
    const refuse = () => {}; // this page cannot show it: its files may be others
    if (known?.text !== JSON.stringify(value)) (async () => FIELDS[name].take(this, value, time))().catch(refuse);
    this.note(name, clock, by);
  }

  forget(now) {
    for (const [id, { at }] of Object.entries(this.others)) if (now - at > GONE) delete this.others[id];
    if (this.button) this.button.hidden = !Object.values(this.others).some(({ look }) => look);
  }

  // --- the desk follows the wearer's look, until the user at the desk looks elsewhere ---

  follow(is) {
    this.follows = is;
    this.button?.setAttribute('aria-pressed', is);
  }

  watch(look) {
    const { viewer } = this;
    if (!this.button) {
      this.button = document.createElement('button');
      Object.assign(this.button, { id: 'follow', type: 'button', textContent: 'Follow the headset' });
      this.button.addEventListener('click', () => this.follow(!this.follows));
      viewer.element.after(this.button);
      this.follow(this.follows);
    }
    const { x = 0, y = 0, z = 0 } = look;
    const moves = Object.entries({ x, y, z }).some(([name, value]) => value !== viewer.state[name]);
    if (moves && this.follows && !viewer.session) viewer.set({ x, y, z }); // draws, so not for every look
    this.wanted = look;
    if (this.moving) return;
    this.moving = true;
    requestAnimationFrame(() => this.move());
  }

  // Moves smoothly, because looks arrive ten times a second.
  move() {
    const { viewer, wanted } = this;
    const by = (name) => wrapDegrees(wanted[name] - viewer.state[name]);
    const rest = ['yaw', 'pitch', 'roll'].map((name) => [name, by(name)]);
    this.moving = this.follows && !viewer.session && rest.some(([, angle]) => Math.abs(angle) > 0.02);
    if (!this.moving) return;
    viewer.set(Object.fromEntries(rest.map(([name, angle]) => [name, viewer.state[name] + (Math.abs(angle) > 0.1 ? 0.35 * angle : angle)])));
    requestAnimationFrame(() => this.move());
  }
}
