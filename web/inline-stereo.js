// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Both eyes in the page itself, where the browser shows a canvas to each eye: a WebXR session of kind `inline` with the
// feature `inline-stereo` (WebXR Device API, draft of 2026-06-09). The browser says which part of its frame is whose.
// The look remains that of the page: dragging turns it, not the head.
import { boxOf } from './modes.js';

const FEATURE = 'inline-stereo';
const indexOf = ({ eye }) => (eye === 'right' ? 1 : 0);

export class InlineStereo {
  // tell(is): called when both eyes are shown, and when they are not any more.
  constructor(viewer, tell) {
    Object.assign(this, { viewer, tell, session: null });
    viewer.addEventListener('sleep', () => this.session?.end().catch(() => {}));
    viewer.addEventListener('open', () => this.start().catch((error) => console.warn('No stereo in the page:', error.message)));
  }

  // Browsers without it refuse the session; they are not asked again.
  async start() {
    const { viewer, viewer: { panorama } } = this;
    if (this.isAsked || !panorama) return;
    this.isAsked = true;
    const session = await navigator.xr.requestSession('inline', { requiredFeatures: [FEATURE] }).catch(() => null);
    if (!session) return;
    if (viewer.panorama !== panorama) return session.end();
    session.updateRenderState({ baseLayer: new XRWebGLLayer(session, panorama.gl, { alpha: false, antialias: false, depth: false, stencil: false }) });
    this.space = await session.requestReferenceSpace('viewer');
    session.addEventListener('end', () => this.ended());
    this.session = viewer.inline = session;
    this.tell(true);
    session.requestAnimationFrame((...next) => this.frame(...next));
  }

  ended() {
    this.session = this.viewer.inline = null;
    this.isAsked = false; // the next picture that opens begins again
    this.tell(false);
    this.viewer.resize();
  }

  frame(now, frame) {
    const { session, viewer } = this;
    if (!session) return;
    session.requestAnimationFrame((...next) => this.frame(...next));
    const pose = frame.getViewerPose(this.space);
    const { panorama, picture } = viewer;
    if (!pose || !picture || viewer.session) return;
    viewer.fit(1, 2);
    picture.refresh?.();
    viewer.still.remove();
    const layer = session.renderState.baseLayer;
    const page = { width: Math.round(viewer.canvas.width / 2), height: viewer.canvas.height };
    const parts = viewer.parts(now, page);
    panorama.clear(layer.framebuffer);
    for (const view of pose.views) {
      const { x, y, width, height } = layer.getViewport(view);
      for (const { box: [left, low, wide, high], ...options } of parts) {
        const within = boxOf([left / page.width, low / page.height, wide / page.width, high / page.height], { width, height });
        const box = [x + within[0], y + within[1], within[2], within[3]];
        // Flat is stereo here; other ways to show the eyes are the same for both.
        const eye = viewer.state.mode === 'left' ? indexOf(view) : options.eye;
        panorama.draw(picture, { ...options, box, clip: box, target: layer.framebuffer, eye, moves: true });
      }
    }
    for (const { pager } of viewer.pictures()) pager?.follow(parts, now);
  }
}
