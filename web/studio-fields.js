// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The content of the studio's panel: groups of rows. A row has the path of its value in the settings, its label, and
// either options or a unit, a step (of the displayed number, which is the value times `scale`) and a range for
// dragging, if the server specifies none; and `when`, for values that do not always apply.
import { PROJECTIONS } from './formats.js';
import { valueAt } from './studio-session.js';

const camera = (path) => `sidecar.${path}`;
const degrees = (radians) => Math.round((radians * 180e6) / Math.PI) / 1e6;
const titled = (name) => name.charAt(0).toUpperCase() + name.slice(1).replace('-', ' ');
const options = (names, words = {}) => names.map((name) => [name, words[name] ?? titled(name)]);

// The numbers of a projection that are missing in the settings.
function standardOf(view, { name }) {
  const { projection } = PROJECTIONS.find((each) => each.name === name)?.camera ?? PROJECTIONS[0].camera;
  const [x, y] = projection.center;
  const [wide, high] = projection.span;
  return {
    ...view.studio.polynomial_lens,
    longitude: [degrees(x - wide / 2), degrees(x + wide / 2)], latitude: [degrees(y - high / 2), degrees(y + high / 2)],
    fov: degrees(projection.angle), pan: 0, tilt: degrees(Math.asin(-projection.lens_back[1])), aspect: 1,
  };
}

const UP = [0, 1, 0]; // the axis of a level camera

const rounded = (value, digits) => Number(value.toFixed(digits));

// The row of the scene's own cameras: its value is the index of the one where the camera stands, or nothing. They are
// level, as those of every command.
const PLACE = 'scene-camera';
const NEAR = 0.006; // metres and degrees: settings are rounded

function cameraOf({ studio }, { sidecar }) {
  const stands = ({ position, yaw }) => {
    const turn = (((sidecar.yaw - yaw) % 360) + 540) % 360 - 180;
    return [turn, sidecar.pitch, sidecar.roll, ...position.map((value, i) => value - sidecar.position[i])].every((value) => Math.abs(value) < NEAR);
  };
  const found = sidecar.position ? studio.cameras.findIndex(stands) : -1;
  return found < 0 ? '' : String(found);
}

export const MODE = /merge_\w+\.mode$/;

export function readValue(view, settings, path) {
  if (path === PLACE) return cameraOf(view, settings);
  if (MODE.test(path) && settings.merge_limit) return 'auto';
  if (path === camera('axis')) return settings.sidecar.axis ? 'own' : 'camera';
  const value = valueAt(settings, path);
  if (value === undefined && path.startsWith(camera('axis.'))) return UP[path.at(-1)];
  if (value !== undefined || !path.startsWith('sidecar.projection.')) return value;
  return valueAt(standardOf(view, settings.sidecar.projection), path.replace('sidecar.projection.', ''));
}

const hasCurve = (which) => (settings) => !settings.merge_limit && !['none', 'map'].includes(settings.sidecar[which].mode);
const mergeRows = (which) => [
  { path: camera(`${which}.mode`), label: 'Curve', merges: true },
  { path: camera(`${which}.start`), label: 'Start', unit: '°', step: 0.5, range: [0, 90], when: hasCurve(which), about: 'Elevation up to which the eyes keep their whole distance' },
  { path: camera(`${which}.end`), label: 'End', unit: '°', step: 0.5, range: [0, 90], when: hasCurve(which), about: 'Elevation from which both eyes see the same' },
  { path: camera(`${which}.exponent`), label: 'Exponent', step: 0.02, range: [0.05, 8], when: hasCurve(which) },
];

export function groupsOf(view) {
  const { studio } = view;
  const maps = (name) => name !== 'map' || studio.settings.maps?.merge >= 0;
  const merges = [['auto', 'As depth allows'], ...options(studio.merges.filter(maps))];
  const merge = (which) => mergeRows(which).map((row) => (row.merges ? { ...row, options: merges } : row));
  const turns = [-180, 180];
  const has = (number) => (settings) => studio.controls[settings.sidecar.projection.name]?.includes(number);
  return [
    { name: 'Camera', open: true, rows: [
      ...(studio.cameras.length ? [{
        path: PLACE, label: 'Scene’s camera', options: [['', 'Another place'], ...studio.cameras.map(({ name }, i) => [String(i), name])],
        edits: (i) => (i ? { [camera('position')]: studio.cameras[i].position.map((value) => rounded(value, 4)), [camera('yaw')]: rounded(studio.cameras[i].yaw, 2), [camera('pitch')]: 0, [camera('roll')]: 0 } : {}),
      }] : []),
      { label: 'Position', parts: ['X', 'Y', 'Z'].map((label, i) => ({ path: camera(`position.${i}`), label, name: `Position ${label}`, unit: 'm', step: 0.01, range: [-1e5, 1e5] })) },
      { label: 'Direction', parts: [
        { path: camera('yaw'), label: 'Yaw', unit: '°', step: 0.5, range: turns },
        { path: camera('pitch'), label: 'Pitch', unit: '°', step: 0.5, range: [-90, 90] },
        { path: camera('roll'), label: 'Roll', unit: '°', step: 0.5, range: turns },
      ] },
    ] },
    { name: 'Light', open: true, rows: [
      { path: 'exposure', label: 'Exposure', unit: 'stops', step: 0.05, range: [-20, 20] },
      { path: 'tone', label: 'Tone', options: options(studio.tones) },
      { path: 'env', label: 'Environment', options: options(studio.envs, { 0: 'None', auto: 'As it suits' }) },
      { label: 'Sun', when: (s) => s.env === 'sky', parts: [
        { path: 'sun.elevation', label: 'Height', name: 'The sun’s height', unit: '°', step: 0.5, range: [0, 90] },
        { path: 'sun.azimuth', label: 'Direction', name: 'The sun’s direction', unit: '°', step: 0.5, range: turns },
      ] },
      { label: 'Around', parts: [
        { path: 'turn', label: 'Turn', name: 'The environment’s turn', unit: '°', step: 0.5, range: turns },
        { path: 'strength', label: 'Strength', name: 'The environment’s strength', step: 0.01, range: [0, 1e6] },
      ] },
      ...(studio.variants.length ? [{ path: 'variant', label: 'Variant', options: [['', 'First'], ...studio.variants.map((name) => [name, name])] }] : []),
      ...(studio.duration ? [{ path: 'time', label: 'Time', unit: 's', step: 0.02, range: [0, studio.duration] }] : []),
    ] },
    { name: 'Comfort: pole merge', id: 'merge', open: true, top: [...merge('merge_top'), { path: 'merge_limit', label: 'Limit', unit: '′', step: 0.1, range: [1, 600], when: (s) => s.merge_limit, about: 'How far the eyes may have to turn apart, up and down' }], bottom: merge('merge_bottom') },
    { name: 'Eyes', open: true, rows: [
      { path: camera('ipd'), label: 'Eye distance', unit: 'mm', scale: 1000, step: 0.5, range: [0, 1000] },
      { path: camera('convergence.mode'), label: 'Convergence', options: options(studio.convergences) },
      { path: camera('convergence.distance'), label: 'Converge at', unit: 'm', step: 0.01, range: [0.01, 1000], when: (s) => s.sidecar.convergence.mode !== 'parallel' },
      { path: camera('neck'), label: 'Neck to eyes', unit: 'mm', scale: 1000, step: 1, range: [-1000, 1000], about: 'Distance of the eyes in front of the axis they turn about' },
      { path: camera('axis'), label: 'Eyes turn about', options: [['camera', 'The camera’s up'], ['own', 'Another axis']], write: (word) => (word === 'own' ? UP : null) },
      { label: 'Axis', when: (s) => s.sidecar.axis, parts: ['X', 'Y', 'Z'].map((label, i) => ({ path: camera(`axis.${i}`), label, name: `Axis ${label}`, step: 0.01, range: [-1, 1] })) },
    ] },
    { name: 'Projection', rows: [
      { path: camera('projection.name'), label: 'Projection', options: studio.projections.map((name) => [name, name]), projection: true },
      { path: camera('projection.fov'), label: 'Field of view', unit: '°', step: 0.5, range: [1, 360], when: has('fov') },
      { path: camera('projection.aspect'), label: 'Aspect', unit: 'w / h', step: 0.01, range: [0.1, 10], when: has('aspect') },
      { path: camera('projection.pan'), label: 'Pan', unit: '°', step: 0.5, range: turns, when: has('lens') },
      { path: camera('projection.tilt'), label: 'Tilt', unit: '°', step: 0.5, range: [-90, 90], when: has('lens') },
      { label: 'Longitude', when: has('range'), parts: [['Left', 0], ['Right', 1]].map(([label, i]) => ({ path: camera(`projection.longitude.${i}`), label, name: `${label} edge`, unit: '°', step: 0.5, range: [-360, 360] })) },
      { label: 'Latitude', when: has('range'), parts: [['Bottom', 0], ['Top', 1]].map(([label, i]) => ({ path: camera(`projection.latitude.${i}`), label, name: `${label} edge`, unit: '°', step: 0.5, range: [-90, 90] })) },
      { label: 'Sensor', when: has('polynomial'), parts: ['Width', 'Height'].map((label, i) => ({ path: camera(`projection.sensor.${i}`), label, name: `Sensor’s ${label.toLowerCase()}`, unit: 'mm', step: 0.1, range: [0.001, 1000] })) },
      ...[0, 1, 2, 3, 4].map((i) => ({ path: camera(`projection.polynomial.${i}`), label: `K${i}`, step: 1e-7, range: [-1e6, 1e6], when: has('polynomial'), about: i ? `Of the ${['', '', 'square', 'cube', 'fourth power'][i]}${i > 1 ? ' of the ' : ''}radius in mm, for the angle in radians` : 'The angle in the middle, in radians' })),
    ] },
    { name: 'Lens', rows: [
      { path: camera('lens.radius'), label: 'Lens radius', unit: 'mm', scale: 1000, step: 0.1, range: [0, 500], about: '0: everything is sharp' },
      { path: camera('lens.focus_distance'), label: 'Focus at', unit: 'm', step: 0.01, range: [0.01, 1000], when: (s) => s.sidecar.lens.radius > 0 },
    ] },
  ];
}

// The limits of a row's displayed number: the server's range of the camera's number at this place in a sidecar, if it
// is one.
export function limitsOf(ranges, { path, range, scale = 1 }) {
  const place = path.replace(/^sidecar\./, '').replace(/\.\d$/, '');
  return ranges?.[place]?.map((value) => value * scale) ?? range;
}
