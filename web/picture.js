// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Loads an item of view.json. A picture, for panorama.js, is
//   { eyes: [left, right] as EyeTexture, camera, mono, changed, free() }
// and the members that video.js adds for a video, `pager` for a large picture, `light` and develop() for one of light.
// It calls changed() when there is something new to draw. A layered scene (layered.js) is a picture, too: it has draw(),
// hold(), drag(), the `actions` that it adds, and the names of those that it `lacks`; the viewer that has opened it calls
// enter().
import { cropOf, formOf, hasOtherLayouts, isRound, same } from './form.js';
import { EyeTexture } from './tiles.js';

const LARGE = 40e6; // texels of both eyes: with mip levels, 213 MB

// Reads a file and reports the fraction loaded, 0..1.
export async function download(url, name, signal, progress) {
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

export async function decode(blob, name, colorSpaceConversion = 'default') {
  try {
    return await createImageBitmap(blob, { premultiplyAlpha: 'none', colorSpaceConversion });
  } catch {
    const what = blob.size === 0 ? 'is empty' : 'cannot be decoded by this browser: it is damaged or too large';
    throw new Error(`${name} ${what}. Try a smaller copy: ods convert ${name} -o small.png --width 4096`);
  }
}

// The addresses of an item's eyes, if the server divides its file according to another layout.
function eyeFiles({ left, right }, layout) {
  const named = (eye) => left.replace(/[^/]*$/, `${eye}.jpg`);
  if (!layout) return [left, right];
  return layout === 'mono' ? [named('mono'), named('mono')] : [named('left'), named('right')];
}

// Both eyes' textures from the source that `crops` divide, or the eyes of pages.js if they are too large.
async function eyesOf(panorama, form, { sources, crops, mono, name, preview, paging, signal, calm }) {
  const { gl } = panorama;
  const wraps = isRound(form.camera);
  const sizes = crops.map((crop, i) => cropOf(crop, sources[i]));
  if (sizes.some(([, , width, height]) => width < 1 || height < 1)) {
    throw new Error(`${name} is too small for this layout. Choose another one.`);
  }
  const texels = sizes.slice(mono ? 1 : 0).reduce((sum, [, , width, height]) => sum + width * height, 0);
  const pages = texels > LARGE || paging ? await import('./pages.js') : null;
  const eyes = [];
  try {
    for (let i = 0; i < (mono ? 1 : 2); i++) {
      const [x, y, width, height] = sizes[i];
      eyes.push(pages ? new pages.PagedEye(gl, sources[i], sizes[i], wraps, paging) : new EyeTexture(gl, width, height, wraps));
      if (pages) await eyes[i].begin(preview ?? sources[i], preview ? cropOf(crops[i], preview) : sizes[i]);
      else await eyes[i].fill(sources[i], x, y, calm);
      signal?.throwIfAborted();
    }
  } catch (error) {
    eyes.forEach((eye) => eye.free());
    throw error;
  }
  if (mono) eyes.push(eyes[0]);
  const picture = { eyes, camera: form.camera, mono, changed: null };
  if (pages) picture.pager = new pages.Pager(panorama, picture);
  picture.free = () => {
    new Set(eyes).forEach((eye) => eye.free());
    picture.pager?.free();
    if (pages) new Set(sources).forEach((source) => source.close());
  };
  return picture;
}

// A small copy that is shown until the picture is loaded; null if there is none.
async function openPreview(panorama, item, form, url, signal, early) {
  const answer = await fetch(url(item.preview), { signal });
  if (!answer.ok) return null;
  const source = await decode(await answer.blob(), item.name);
  const crops = [form.layout.left, form.layout.right];
  early(await eyesOf(panorama, form, { sources: [source, source], crops, mono: same(...crops), name: item.name, signal }));
  return source;
}

async function openImage(panorama, item, form, files, url, { signal, progress, early, paging, ahead, load, calm }) {
  const crops = item.image ? [form.layout.left, form.layout.right] : [[0, 0, 1, 1], [0, 0, 1, 1]];
  const mono = files.length === 1 ? same(...crops) : files[0].href === files[1].href;
  const preview = item.preview && early && !ahead?.isReady ? openPreview(panorama, item, form, url, signal, early).catch(() => null) : null;
  const read = load ?? (async (file, i) => decode(await download(file, item.name, signal, (part) => progress?.((part + i) / files.length)), item.name));
  const sources = [];
  let picture = null;
  try {
    picture = await ahead?.picture;
    if (picture) return picture;
    for (const [i, file] of files.entries()) {
      if (i === 1 && mono) break;
      sources.push(await read(file, i));
      signal?.throwIfAborted();
    }
    if (sources.length === 1) sources.push(sources[0]);
    picture = await eyesOf(panorama, form, { sources, crops, mono, name: item.name, preview: await preview, paging, signal, calm });
    return picture;
  } finally {
    (await preview)?.close();
    if (!picture?.pager) new Set(sources).forEach((source) => source.close());
  }
}

// Scene-linear light: halves, in a picture format that browsers read (FrameCutter). The last one is kept, for other
// layouts.
async function openLight(panorama, item, form, url, choice, { signal, progress }) {
  const { gl } = panorama;
  const address = url(item.light).href;
  if (panorama.kept?.address !== address) {
    const blob = await download(address, item.name, signal, progress);
    panorama.kept?.source.close();
    panorama.kept = null;
    panorama.kept = { address, source: await decode(blob, item.name, 'none') };
  }
  const { source } = panorama.kept;
  const crops = [form.layout.left, form.layout.right].map((crop) => cropOf(crop, { width: source.width / 2, height: source.height }));
  const mono = same(...crops);
  const eyes = crops.slice(mono ? 1 : 0).map(([, , width, height]) => new EyeTexture(gl, width, height, isRound(form.camera), true));
  if (mono) eyes.push(eyes[0]);
  const { FrameCutter } = await import('./frame-cutter.js');
  const cutter = new FrameCutter(gl, true);
  cutter.take(source, eyes);
  eyes.forEach((eye, i) => cutter.prepare(eye, crops[i], true));
  cutter.free();
  return {
    eyes, camera: form.camera, mono, light: true, changed: null,
    // Sets exposure and tone curve, which the shader applies.
    develop({ exposure = item.exposure, tone = item.tone }) {
      Object.assign(this, { stops: exposure, tone });
      return this;
    },
    free: () => new Set(eyes).forEach((eye) => eye.free()),
  }.develop(choice);
}

// An address of an item's file, with what a server of ods view is asked for.
function addressOf(path, base, query = {}) {
  const address = new URL(path, base ?? location.href);
  for (const [name, value] of Object.entries(query)) if (value !== undefined) address.searchParams.set(name, value);
  return address;
}

// The addresses of a picture's file or of its eyes' files.
function imageAddresses(view, item, base, choice = {}) {
  const layout = !item.image && hasOtherLayouts(view, item) ? choice.layout : undefined;
  const { exposure, tone } = item.live ? choice : {};
  return (item.image ? [item.image] : eyeFiles(item, layout)).map((path) => addressOf(path, base, { layout, exposure, tone }));
}

// base: the address that the item's addresses are relative to. choice: { layout, projection, exposure, tone }, all
// optional. early(picture): receives a preview of the picture. ahead: what ahead.js has of the picture, if anything; load(url)
// and calm(): its own ways to read a file, and to wait before each piece that is sent to the GPU. paging: whether to use
// pages.js, by default depending on the picture's size. Throws an Error with one line for the user, or an AbortError if
// `signal` is aborted.
export async function openPicture(panorama, view, item, { base, choice = {}, ...how } = {}) {
  const form = formOf(item, choice);
  const url = (path) => addressOf(path, base);
  if (item.kind === 'video') {
    const { openVideo } = await import('./video.js');
    return openVideo(panorama.gl, item, form, url(item.image), how.signal);
  }
  if (item.kind === 'layers') {
    const { openLayered } = await import('./layered.js');
    return openLayered(panorama, item, form, url(item.image), { base, choice, ...how });
  }
  const isLight = item.light && panorama.hasLight;
  const picture = await (isLight ? openLight(panorama, item, form, url, choice, how) : openImage(panorama, item, form, imageAddresses(view, item, base, choice), url, how));
  // The picture does not wait for its objects.
  if (item.stage && item.objects.length && !choice.layout && !choice.projection) picture.enter = (viewer) => import('./objects.js').then(() => import('./objects-panorama.js')).then(({ enterStage }) => enterStage(picture, viewer, panorama, item, { base, choice, ...how })).catch(({ message }) => viewer.picture === picture && console.warn(message));
  return picture;
}
