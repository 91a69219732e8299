// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Adapts the resolution of a moving view to the duration of its frames: lower if they are late, and higher again if
// there is time. A reduction that does not help is undone, because then the GPU is not the bottleneck.
const LEVELS = [{ scale: 1 }, { scale: 1, cheap: true }, { scale: 0.7, cheap: true }, { scale: 0.5, cheap: true }];
const COUNT = 4; // frames that are evaluated together
const PATIENCE = 2000; // milliseconds from a reduction to the next attempt; doubled each time

export class Pace {
  // period: the target duration of a frame, milliseconds.
  constructor(period = 1000 / 60) {
    Object.assign(this, { period, level: 0, times: [], before: 0, until: 0, wait: PATIENCE, stuck: 0 });
  }

  // scale: of the canvas; cheap: as in panorama.js.
  get how() {
    return LEVELS[this.level];
  }

  // Records the duration of a frame, milliseconds.
  took(time, now = performance.now()) {
    this.times.push(time);
    if (this.times.length < COUNT) return;
    const median = this.times.sort((a, b) => a - b)[COUNT / 2];
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
