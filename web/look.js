// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Turns the viewer's look by mouse, touch, wheel and the device's own orientation.
import { clamp, degrees, dot, radians } from './geometry.js';
import { fovOf, halfSide, halfWidth } from './panorama.js';

// Dragging moves the picture: the point grabbed follows the pointer exactly at the middle of the view. hasWheel():
// whether the wheel belongs to the picture, and not to the page around it.
export function followPointer(viewer, element = viewer.element, hasWheel = () => true) {
  const held = new Map();
  const spread = () => {
    const [a, b] = [...held.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  element.addEventListener('pointerdown', (event) => {
    if (event.button || event.defaultPrevented) return;
    element.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener('pointermove', (event) => {
    const last = held.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    const { yaw, pitch, fov, mode, planet } = viewer.state;
    const parts = mode === 'side-by-side' || mode === 'cross-eyed' ? 2 : 1;
    const aspect = element.clientWidth / parts / element.clientHeight;
    const pixel = degrees((2 * parts * halfWidth({ fov, planet }, aspect)) / element.clientWidth);
    const drag = (x, y) => viewer.picture?.drag?.(viewer, x * pixel, y * pixel);
    if (held.size === 2) {
      const before = spread();
      Object.assign(last, { x: event.clientX, y: event.clientY });
      drag(dx / 2, dy / 2); // their middle
      return viewer.set({ fov: fovOf(halfSide({ fov, planet }) * (before / Math.max(spread(), 1)), planet) });
    }
    Object.assign(last, { x: event.clientX, y: event.clientY });
    if (event.shiftKey && viewer.picture?.drag) return drag(dx, dy);
    viewer.set({ yaw: yaw - dx * pixel, pitch: pitch + dy * pixel });
  });
  for (const end of ['pointerup', 'pointercancel']) {
    element.addEventListener(end, (event) => held.delete(event.pointerId));
  }
  element.addEventListener('wheel', (event) => {
    if (event.defaultPrevented || !hasWheel()) return;
    event.preventDefault();
    const lines = event.deltaMode === 0 ? event.deltaY / 40 : event.deltaY;
    viewer.set({ fov: viewer.state.fov * Math.exp(lines * 0.03) });
  }, { passive: false });
}

// The look of a device, from the angles of a `deviceorientation` event and the turn of its screen, all in degrees.
// W3C Device Orientation: Z X' Y'' rotations of a device whose x is right, y up and z out of the screen, in a world whose
// z is up.
export function lookOfDevice(alpha, beta, gamma, screenTurn) {
  const [a, b, g, s] = [alpha, beta, gamma, screenTurn].map(radians);
  const [ca, sa, cb, sb, cg, sg] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b), Math.cos(g), Math.sin(g)];
  const x = [ca * cg - sa * sb * sg, sa * cg + ca * sb * sg, -cb * sg];
  const y = [-sa * cb, ca * cb, sb];
  const ahead = [-(ca * sg + sa * sb * cg), -(sa * sg - ca * sb * cg), -cb * cg];
  const right = x.map((value, i) => value * Math.cos(s) - y[i] * Math.sin(s));
  const yaw = Math.atan2(ahead[0], ahead[1]);
  const pitch = Math.asin(clamp(ahead[2], -1, 1));
  const level = [Math.cos(yaw), -Math.sin(yaw), 0];
  const top = [-Math.sin(pitch) * Math.sin(yaw), -Math.sin(pitch) * Math.cos(yaw), Math.cos(pitch)];
  return { yaw: degrees(yaw), pitch: degrees(pitch), roll: degrees(Math.atan2(-dot(right, top), dot(right, level))) };
}

export const hasDevice = () => 'DeviceOrientationEvent' in window && matchMedia('(pointer: coarse)').matches;

// Returns a function that ends it; null if the user refuses. The look starts from the present one.
export async function followDevice(viewer) {
  const ask = window.DeviceOrientationEvent?.requestPermission;
  if (ask && (await ask.call(DeviceOrientationEvent).catch(() => 'denied')) !== 'granted') return null;
  let last = null;
  const turn = ({ alpha, beta, gamma }) => {
    if (alpha === null) return;
    const look = lookOfDevice(alpha, beta, gamma, screen.orientation?.angle ?? 0);
    const { yaw } = viewer.state;
    viewer.set({ ...look, yaw: yaw + look.yaw - (last ?? look.yaw) });
    last = look.yaw;
  };
  addEventListener('deviceorientation', turn);
  return () => {
    removeEventListener('deviceorientation', turn);
    viewer.set({ roll: 0 });
  };
}
