// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves the camera of the studio as a person moves: W A S D walk where the view looks, and a point on a floor becomes
// the place to stand, with the eyes as high above it as they are above what is below them now.
import { radians } from './geometry.js';
import { ask } from './studio-session.js';

const STEP = 4; // eye distances: 26 cm for a person, little in a small world
const FINE = 0.8;
const HIGH = 25; // eye distances: the height of the eyes if nothing is below them
const ASIDE = 1; // degree between the directions that show how steep a surface is
const STEEP = 0.7; // cosine of the steepest floor's angle

const rounded = (point) => point.map((value) => Number(value.toFixed(4)));

// Returns whether three points are of a surface that people can stand on.
export function isFloor([a, b, c]) {
  const [u, v] = [b, c].map((each) => each.map((value, i) => value - a[i]));
  const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  return Math.abs(normal[1]) > STEEP * Math.hypot(...normal);
}

export class Walk {
  constructor(studio) {
    this.studio = studio;
  }

  get camera() {
    return this.studio.session.settings.sidecar;
  }

  // The scene's own eye distance, which scales the steps; settings may have none.
  unit() {
    return this.studio.page.viewer.view.studio.settings.sidecar.ipd || 0.065;
  }

  go(right, ahead) {
    const { position: [x, y, z], yaw } = this.camera;
    const heading = radians(yaw + this.studio.page.viewer.state.yaw);
    const [sine, cosine] = [Math.sin(heading), Math.cos(heading)];
    const by = this.unit();
    this.put([x + by * (right * cosine + ahead * sine), y, z + by * (right * sine - ahead * cosine)]);
  }

  put(point) {
    this.studio.session.edit({ 'sidecar.position': rounded(point) }, 'walk');
  }

  // Stands on a picked point. direction: from the camera to it. Returns a message if the surface is too steep, else ''.
  async stand({ point, direction }) {
    const picked = (yaw, pitch) => ask('pick', { ...direction, yaw, pitch });
    const { yaw, pitch } = direction;
    const aside = Math.min(90, ASIDE / Math.cos(radians(pitch))); // straight below, yaw alone leads nowhere
    const beside = await Promise.all([picked(yaw, pitch + ASIDE), picked(yaw + aside, pitch + ASIDE)]);
    if (beside.some(({ nothing }) => nothing) || !isFloor([point, ...beside.map((each) => each.point)])) return 'That is too steep to stand on: click on a floor.';
    const below = await picked(0, -90);
    const high = below.nothing ? HIGH * this.unit() : this.camera.position[1] - below.point[1];
    this.put([point[0], point[1] + high, point[2]]);
    return '';
  }

  // The rows of the keys (actions.js), which replace those of pictures.
  keys(when) {
    const row = (key, right, ahead, more) => ({
      id: `walk-${key}`, keys: [key], group: 'Studio', when, run: () => this.go(STEP * right, STEP * ahead), fine: () => this.go(FINE * right, FINE * ahead), ...more,
    });
    return [row('w', 0, 1, { shown: 'W A S D', label: 'walk (Shift: finely)' }), row('s', 0, -1), row('a', -1, 0), row('d', 1, 0)];
  }
}
