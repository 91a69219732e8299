// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0

const PATIENCE = 400e3; // milliseconds: a software GPU beside other tests takes a minute for a picture

export const sleep = (time) => new Promise((done) => setTimeout(done, time));

export function expect(is, what) {
  if (!is) throw new Error(what);
}

export async function until(is, what) {
  for (const end = performance.now() + PATIENCE; performance.now() < end;) {
    if (is()) return;
    await sleep(50);
  }
  throw new Error(`never ${what}`);
}
