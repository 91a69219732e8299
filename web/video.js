// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A video as a picture whose eyes change. The browser decodes; requested times are the middles of frames, so that
// rounding cannot show an adjacent frame.
import { cropOf, isRound, same } from './form.js';
import { FrameCutter } from './frame-cutter.js';
import { clamp } from './geometry.js';
import { EyeTexture } from './tiles.js';

const SETTLE = 150; // milliseconds
const REASONS = {
  1: 'stopped loading. Reload the page.',
  2: 'did not load: the connection broke. Is the server still running?',
  3: 'is damaged, or its codec is too much for this browser. Try H.264: ods encode --codec h264',
  4: 'has a codec or a container that this browser does not play. Try H.264 in MP4: ods encode --codec h264 -o video.mp4',
};

const HLS = 'application/vnd.apple.mpegurl'; // .m3u8

function whenLoaded(video, name, signal) {
  return new Promise((done, fail) => {
    const failed = () => fail(new Error(`${name} ${REASONS[video.error?.code] ?? REASONS[4]}`));
    video.addEventListener('loadeddata', done, { once: true, signal });
    video.addEventListener('error', failed, { once: true, signal });
    signal?.addEventListener('abort', () => fail(signal.reason), { once: true });
  });
}

// From disk, browsers show videos but do not give pages their pixels, unless the page has the bytes (bundle.js).
async function fromDisk(url, name) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${name} did not load: ${await answer.text()}`);
  return URL.createObjectURL(await answer.blob());
}

// Throws if the browser does not play such files.
function makeVideo(src, url, name) {
  const video = document.createElement('video');
  if (/\.m3u8$/i.test(url.pathname) && !video.canPlayType(HLS)) {
    throw new Error(`${name} is HLS, which this browser does not play. Name an .mp4 of the same film`);
  }
  if (url.origin !== location.origin) video.crossOrigin = 'anonymous'; // else WebGL may not show it
  return Object.assign(video, { src, preload: 'auto', playsInline: true });
}

export async function openVideo(gl, item, form, url, signal) {
  const src = url.protocol === 'file:' ? await fromDisk(url, item.name) : url.href;
  const video = makeVideo(src, url, item.name);
  const close = () => {
    URL.revokeObjectURL(src);
    video.pause();
    video.removeAttribute('src');
    video.load();
  };
  try {
    await whenLoaded(video, item.name, signal);
  } catch (error) {
    close();
    throw error;
  }
  const fps = item.video?.fps || 30;
  const file = { width: video.videoWidth, height: video.videoHeight };
  const crops = [cropOf(form.layout.left, file), cropOf(form.layout.right, file)];
  const mono = same(...crops);
  const wraps = isRound(form.camera);
  const left = new EyeTexture(gl, crops[0][2], crops[0][3], wraps);
  const eyes = [left, mono ? left : new EyeTexture(gl, crops[1][2], crops[1][3], wraps)];
  const cutter = new FrameCutter(gl);
  const frames = item.video?.frames || Math.round(video.duration * fps);
  let mediaTime = 0;
  let isNew = true;
  let wanted = 0; // the frame of a step in progress
  const heard = new AbortController();

  // The browser reports new frames; after a seek and at the end, the frame follows from the time.
  const arrive = (time) => {
    mediaTime = time;
    isNew = true;
    picture.changed?.();
  };
  const listen = () => video.requestVideoFrameCallback?.((now, about) => {
    arrive(about.mediaTime);
    listen();
  });
  // After a seek, browsers report it before the frame can be copied, so it is copied once more.
  video.addEventListener('seeked', () => setTimeout(() => arrive(mediaTime), SETTLE), { signal: heard.signal });
  for (const event of ['seeked', 'ended', ...(video.requestVideoFrameCallback ? [] : ['timeupdate'])]) {
    video.addEventListener(event, () => arrive(Math.floor(video.currentTime * fps + 0.01) / fps), { signal: heard.signal });
  }
  // Only while it plays: a paused video that loops would jump from its last frame to its first one.
  for (const event of ['play', 'pause']) {
    video.addEventListener(event, () => picture.loop(picture.loops), { signal: heard.signal });
  }
  for (const event of ['volumechange', 'ratechange']) {
    video.addEventListener(event, () => picture.changed?.(), { signal: heard.signal });
  }

  const picture = {
    eyes, camera: form.camera, layout: form.layout, mono, video, fps, frames, loops: true,
    changed: null, // called when there is something new to draw or to report
    frame: () => Math.min(Math.floor(mediaTime * fps + 0.5), frames - 1),
    // Before drawing: copies a new frame to the GPU; and then for an eye that is drawn, into its texture (FrameCutter).
    refresh() {
      if (!isNew || video.readyState < 2) return;
      isNew = false;
      cutter.take(video, eyes);
    },
    prepare: (eye, isReduced) => cutter.prepare(eye, crops[eyes.indexOf(eye)], isReduced),
    loop(is) {
      picture.loops = is;
      video.loop = is && !video.paused;
      picture.changed?.();
    },
    toggle: () => (video.paused ? video.play().catch(() => {}) : video.pause()),
    seek(seconds) {
      if (!Number.isFinite(frames)) return; // a live stream
      wanted = clamp(Math.floor(seconds * fps), 0, frames - 1);
      video.currentTime = (wanted + 0.5) / fps;
    },
    step(count) {
      video.pause();
      const from = video.seeking ? wanted : picture.frame();
      wanted = clamp(from + count, 0, frames - 1);
      video.currentTime = (wanted + 0.5) / fps;
    },
    free() {
      heard.abort();
      picture.changed = null;
      close();
      cutter.free();
      new Set(eyes).forEach((eye) => eye.free());
    },
  };
  listen();
  return picture;
}
