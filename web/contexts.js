// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The panoramas (panorama.js) of a page, each with a WebGL context. Browsers end the oldest context when a page has more
// than about 16, and an unused one lives until its memory is collected; so at most MAX are made, and lent. A borrower
// { isSeen, isBusy(), wake(panorama), sleep() } claims one while it is near the window; sleep() returns it. If there are
// too many borrowers, one that is not seen falls asleep, else the one that was used least recently; only one that is seen
// makes another sleep that is seen.
import { Panorama } from './panorama.js';

const MAX = 8;

const awake = new Set(); // the one used least recently first
const waiting = new Set();
const spare = [];

function giveBack(one) {
  awake.delete(one);
  const panorama = one.sleep();
  if (panorama && !panorama.gl.isContextLost()) spare.push(panorama);
}

// The borrower that can sleep instead of one.
function idleFor(one) {
  const idle = [...awake].filter((each) => !each.isBusy());
  return idle.find((each) => !each.isSeen) ?? (one.isSeen ? idle[0] : undefined);
}

function serve() {
  for (const one of [...waiting].sort((a, b) => b.isSeen - a.isSeen)) {
    if (awake.size >= MAX) {
      const idle = idleFor(one);
      if (!idle) continue;
      giveBack(idle);
    }
    waiting.delete(one);
    const panorama = spare.pop() ?? new Panorama();
    awake.add(one);
    one.wake(panorama);
  }
}

// Wakes a borrower as soon as possible, or remembers that it is used now. Throws what new Panorama() does.
export function claim(one) {
  if (awake.delete(one)) return awake.add(one);
  waiting.add(one);
  serve();
}

export function release(one) {
  waiting.delete(one);
  if (awake.has(one)) giveBack(one);
  serve();
}

// Called when a borrower is no longer busy.
export const settled = () => serve();
