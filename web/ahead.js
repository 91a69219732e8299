// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The pictures that a visitor is likely to open next, opened while the viewer rests: fetched, decoded, and sent to the
// GPU in pieces between frames. One of them then appears in the next frame.
import { decode } from './picture.js';

const BYTES = 24e6; // of a file
const TEXELS = 17e6; // of a picture: 4096 x 4096
const TOTAL = 34e6; // of all that are kept: with mip levels, 181 MB
const PATIENCE = 500; // milliseconds until a piece is sent although nothing idles

const idle = () => new Promise((go) => (window.requestIdleCallback ? requestIdleCallback(go, { timeout: PATIENCE }) : setTimeout(go, 50)));

export class Ahead {
  constructor() {
    this.kept = new Map(); // by key: { picture: a promise, of null if it failed; isReady, texels, ... }
    this.last = Promise.resolve();
  }

  // wanted: [{ key, open(how) }], the most likely one first; how: of openPicture(). Opens them one after another, and frees
  // all others.
  keep(wanted) {
    for (const [key, entry] of this.kept) {
      if (wanted.some((each) => each.key === key)) continue;
      this.kept.delete(key);
      entry.stop.abort();
      entry.picture.then((picture) => picture?.free());
    }
    for (const { key, open } of wanted) if (!this.kept.has(key)) this.kept.set(key, this.begin(open));
  }

  begin(open) {
    const stop = new AbortController();
    const { signal } = stop;
    const entry = { stop, texels: 0, hasBegun: false, isReady: false, isTaken: false };
    const run = async () => {
      signal.throwIfAborted();
      entry.hasBegun = true;
      const calm = async () => {
        if (!entry.isTaken) await idle();
        signal.throwIfAborted();
      };
      const picture = await open({ signal, calm, load: (file) => this.load(file, entry) });
      entry.isReady = true;
      return picture;
    };
    this.last = entry.picture = this.last.then(run).catch(() => null);
    return entry;
  }

  async load(file, entry) {
    const answer = await fetch(file, { priority: 'low', signal: entry.stop.signal });
    if (!answer.ok || Number(answer.headers.get('content-length')) > BYTES) throw new Error('too large');
    const image = await decode(await answer.blob(), file.href);
    entry.texels += image.width * image.height;
    const total = [...this.kept.values()].reduce((sum, { texels }) => sum + texels, 0);
    if (entry.texels <= TEXELS && total <= TOTAL) return image;
    image.close();
    entry.texels = 0;
    throw new Error('too large');
  }

  // Keeps a picture that is no longer shown, until the next call of keep().
  give(key, picture) {
    const texels = picture.eyes.reduce((sum, { size }) => sum + size[0] * size[1], 0);
    if (this.kept.has(key) || texels > TEXELS) return false;
    this.kept.set(key, { stop: new AbortController(), texels, hasBegun: true, isReady: true, picture: Promise.resolve(picture) });
    return true;
  }

  // Removes a picture and returns what `kept` has of it, for the caller to free; nothing if it has not been begun.
  take(key) {
    const entry = this.kept.get(key);
    this.kept.delete(key);
    if (!entry?.hasBegun) return entry?.stop.abort();
    entry.isTaken = true;
    return entry;
  }
}
