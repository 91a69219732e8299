// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Loads an item of view.json. A picture, for panorama.js, is
//   { eyes: [left, right] as EyeTexture, camera, mono, free() }   and a video's also what video.js adds.
import { cropOf, formOf, hasOtherLayouts, isRound, same } from './form.js';
import { EyeTexture } from './tiles.js';
import { openVideo } from './video.js';

// Reads a file and reports how much of it has come, 0..1.
async function download(url, name, signal, progress) {
  const answer = await fetch(url, { signal }).catch((error) => {
    if (error.name === 'AbortError') throw error;
    throw new Error(`${name} did not load: there is no connection. Is the server still running?`);
  });
  if (!answer.ok) {
    const why = answer.headers.get('content-type')?.startsWith('text/plain') ? `: ${await answer.text()}` : '';
    throw new Error(`${name} did not load (${answer.status})${why}. Reload the page, or open another picture.`);
  }
  const size = Number(answer.headers.get('content-length'));
  if (!size || answer.headers.get('content-encoding')) return answer.blob();
  const parts = [];
  let got = 0;
  const reader = answer.body.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    got += part.value.length;
    progress?.(got / size);
  }
  return new Blob(parts, { type: answer.headers.get('content-type') ?? '' });
}

async function decode(blob, name) {
  try {
    return await createImageBitmap(blob, { premultiplyAlpha: 'none' });
  } catch {
    const what = blob.size === 0 ? 'is empty' : 'cannot be decoded by this browser: it is damaged or too large';
    throw new Error(`${name} ${what}. Try a smaller copy: ods convert ${name} -o small.png --width 4096`);
  }
}

// The addresses of an item's eyes, where the server divides its file as another layout has it.
function eyeFiles({ left, right }, layout) {
  const named = (eye) => left.replace(/[^/]*$/, `${eye}.jpg`);
  if (!layout) return [left, right];
  return layout === 'mono' ? [named('mono'), named('mono')] : [named('left'), named('right')];
}

async function openImage(gl, item, form, layout, url, signal, progress) {
  const wraps = isRound(form.camera);
  const [left, right] = eyeFiles(item, layout);
  const files = item.image ? [url(item.image)] : [url(left), url(right)];
  const crops = item.image ? [form.layout.left, form.layout.right] : [[0, 0, 1, 1], [0, 0, 1, 1]];
  const mono = files.length === 1 ? same(...crops) : left === right;
  const eyes = [];
  const free = () => new Set(eyes).forEach((eye) => eye.free());
  let source = null;
  try {
    for (let i = 0; i < 2; i++) {
      if (i === 1 && mono) {
        eyes.push(eyes[0]);
        break;
      }
      if (!source || files.length === 2) {
        const blob = await download(files[i], item.name, signal, (part) => progress?.((part + i) / files.length));
        source?.close();
        source = await decode(blob, item.name);
      }
      const [x, y, width, height] = cropOf(crops[i], source);
      if (width < 1 || height < 1) throw new Error(`${item.name} is too small for this layout. Choose another one.`);
      const eye = new EyeTexture(gl, width, height, wraps);
      eyes.push(eye);
      await eye.fill(source, x, y);
      signal?.throwIfAborted();
    }
  } catch (error) {
    free();
    throw error;
  } finally {
    source?.close();
  }
  return { eyes, camera: form.camera, mono, free };
}

// base: the address that the item's addresses are relative to. choice: { layout, projection, exposure, tone }, all
// optional. Throws an Error with one line for the user, or an AbortError if `signal` says stop.
export async function openPicture(panorama, view, item, { base, choice = {}, signal, progress } = {}) {
  const form = formOf(view, item, choice);
  const layout = !item.image && hasOtherLayouts(view, item) ? choice.layout : undefined;
  const url = (path) => {
    const address = new URL(path, base ?? location.href);
    if (layout) address.searchParams.set('layout', layout);
    if (item.live && choice.exposure !== undefined) address.searchParams.set('exposure', choice.exposure);
    if (item.live && choice.tone) address.searchParams.set('tone', choice.tone);
    return address;
  };
  if (item.kind === 'video') return openVideo(panorama.gl, item, form, url(item.image), signal);
  return openImage(panorama.gl, item, form, layout, url, signal, progress);
}
