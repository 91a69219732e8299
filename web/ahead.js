// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The next and the previous picture of a folder, fetched and decoded while the viewer rests, so that they open at once.
import { decode } from './picture.js';

const BYTES = 24e6; // of a file
const TEXELS = 17e6; // of a picture: 4096 x 4096

async function load(address) {
  const answer = await fetch(address, { priority: 'low' });
  if (!answer.ok || Number(answer.headers.get('content-length')) > BYTES) return null;
  const image = await decode(await answer.blob(), address);
  if (image.width * image.height <= TEXELS) return image;
  image.close();
  return null;
}

export class Ahead {
  constructor() {
    this.kept = new Map(); // by address: promises of images, or of null for those that are not kept
    this.there = new Set(); // the addresses of images that are decoded
  }

  // Keeps the images at these addresses and frees all others.
  keep(addresses) {
    for (const [address, image] of this.kept) {
      if (addresses.includes(address)) continue;
      this.kept.delete(address);
      this.there.delete(address);
      image.then((each) => each?.close());
    }
    for (const address of addresses) {
      if (this.kept.has(address)) continue;
      const image = load(address).catch(() => null);
      this.kept.set(address, image);
      image.then((each) => each && this.kept.get(address) === image && this.there.add(address));
    }
  }

  // Removes an image and returns it, for the caller to close; null if it is not kept.
  async take(address) {
    const image = this.kept.get(address);
    this.kept.delete(address);
    this.there.delete(address);
    return (await image) ?? null;
  }
}
