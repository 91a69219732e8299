// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The panorama of three.js as a component of A-Frame:
//   <a-entity stereo-360="src: #picture; layout: top-bottom; projection: lat-long"></a-entity>
// src is an <img> or a <video> of the page, or an address.
import { makePanorama } from './three.js';

function textureOf(THREE, source) {
  if (typeof source === 'string') return new THREE.TextureLoader().load(source);
  if (source instanceof HTMLVideoElement) return new THREE.VideoTexture(source);
  const texture = new THREE.Texture(source);
  const load = () => (texture.needsUpdate = true);
  if (source.complete ?? true) load();
  else source.addEventListener('load', load, { once: true });
  return texture;
}

// Registers it with A-Frame, which is the page's global AFRAME.
export function registerStereo360(AFRAME) {
  const { THREE } = AFRAME;
  AFRAME.registerComponent('stereo-360', {
    schema: { src: { type: 'map' }, layout: { default: 'top-bottom' }, projection: { default: 'lat-long' }, swap: { default: false } },
    update() {
      this.remove();
      const { src, ...format } = this.data;
      if (!src) return;
      this.panorama = makePanorama(THREE, { texture: textureOf(THREE, src), ...format });
      this.el.setObject3D('mesh', this.panorama);
    },
    remove() {
      if (!this.panorama) return;
      const { geometry, material } = this.panorama;
      this.el.removeObject3D('mesh');
      material.uniforms.picture.value.dispose();
      material.dispose();
      geometry.dispose();
      this.panorama = null;
    },
  });
}

if (globalThis.AFRAME && !AFRAME.components['stereo-360']) registerStereo360(globalThis.AFRAME);
