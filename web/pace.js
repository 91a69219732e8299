// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Adapts the resolution of a moving view to the duration of its frames: lower if they are late, and higher again if
// there is time. A reduction that does not help is undone, because then the GPU is not the bottleneck.
import { keep, recall } from './storage.js';

const LEVELS = [{ scale: 1 }, { scale: 1, cheap: true }, { scale: 0.7, cheap: true }, { scale: 0.5, cheap: true }];
const COUNT = 4; // frames that are evaluated together
const FIRST = 2; // frames that are evaluated at first
const PATIENCE = 2000; // milliseconds from a reduction to the next attempt; doubled each time

const KEY = 'stereo-360 pace'; // of storage.js
const SOFTWARE = /swiftshader|llvmpipe|softpipe|basic render/i;

// Returns the level that this device ended with the last time; at first, software GPUs do not begin with the best one.
export function firstLevel(gl) {
  const kept = Number(recall(KEY) ?? NaN);
  if (LEVELS[kept]) return kept;
  const about = gl.getExtension('WEBGL_debug_renderer_info');
  return about && SOFTWARE.test(gl.getParameter(about.UNMASKED_RENDERER_WEBGL)) ? 1 : 0;
}

export const keepLevel = (level) => keep(KEY, level);

export class Pace {
  // period: the target duration of a frame, milliseconds. level: of LEVELS, to begin with.
  constructor({ period = 1000 / 60, level = 0 } = {}) {
    Object.assign(this, { period, level, times: [], count: FIRST, before: 0, until: 0, wait: PATIENCE, stuck: 0 });
  }

  get isSlow() {
    return this.level > 0;
  }

  // scale: of the canvas; cheap: as in panorama.js.
  get how() {
    return LEVELS[this.level];
  }

  // Records the duration of a frame, milliseconds.
  took(time, now = performance.now()) {
    this.times.push(time);
    if (this.times.length < this.count) return;
    const median = this.times.sort((a, b) => a - b)[this.count / 2];
    this.count = COUNT;
    this.times = [];
    const isLate = median > 1.7 * this.period;
    if (isLate && this.before && median > 0.9 * this.before) {
      Object.assign(this, { level: this.level - 1, before: 0, stuck: now + 5 * PATIENCE });
    } else if (isLate && now >= this.stuck && this.level + 1 < LEVELS.length) {
      Object.assign(this, { level: this.level + 1, before: median, until: now + this.wait, wait: Math.min(2 * this.wait, 32 * PATIENCE) });
    } else {
      this.before = 0;
      if (median < 1.2 * this.period && this.level && now > this.until) this.level--;
    }
  }
}
