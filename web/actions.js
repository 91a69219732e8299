// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The actions of keys and buttons in one table, from which help and tooltips are made, too. A row has its id for
// buttons, its keys as in KeyboardEvent.key, its label and its group for users, and if it does not always apply,
// when(viewer, player). run(player, viewer) may return, or promise, a short text to display.
import { MODES, modeOf } from './modes.js';
import { hasDevice } from './look.js';
import { FOV } from './viewer.js';
import { t } from './translate.js';

const turn = (yaw, pitch) => (player, viewer) =>
  viewer.set({ yaw: viewer.state.yaw + yaw, pitch: viewer.state.pitch + pitch });
const zoom = (by) => (player, viewer) => viewer.set({ fov: viewer.state.fov * by });
const film = (run) => (player, viewer) => viewer.picture?.video && run(viewer.picture, viewer.picture.video);
const isFilm = ({ about, picture }) => about?.kind === 'video' || Boolean(picture?.film);
const isLive = (viewer) => viewer.about?.live;
const isPicture = (viewer) => Boolean(viewer.picture) && !viewer.scene;
const isJudged = (viewer, player) => Boolean(viewer.picture) && viewer.view.live && !isFilm(viewer) && !player.studio?.comparing;
const isFolder = (viewer, player) => viewer.view.items.length > 1 && !player.isSingle();

function show(viewer, name) {
  viewer.set({ mode: name });
  return t(modeOf(name).label);
}

function expose(viewer, by) {
  viewer.expose(by);
  return t('Exposure {} stops', viewer.choice.exposure);
}

function converge(viewer, by) {
  viewer.set({ shift: Math.round((viewer.state.shift + by) * 10) / 10 });
  const { shift } = viewer.state;
  return shift ? t(shift > 0 ? 'Everything {}° farther' : 'Everything {}° nearer', Math.abs(shift)) : t('Depth as in the file');
}

// Shows everything around as a disc, with the nadir in the middle; or returns to the previous view.
function planet(player, viewer) {
  const { state } = viewer;
  if (!state.planet) player.before = { pitch: state.pitch, fov: state.fov };
  viewer.set(state.planet ? { pitch: 0, fov: FOV, ...player.before, planet: false } : { pitch: -90, fov: 260, planet: true });
  return t(state.planet ? 'Little planet' : 'Panorama');
}

// Returns whether this is Safari on visionOS, which has controls of <img>, and <model>.
const hasSystemPlayer = () => 'controls' in HTMLImageElement.prototype || 'HTMLModelElement' in window;

const LOOK = 'Look around';
const EYES = 'Eyes';
const FILM = 'Video';
const FOLDER = 'Pictures';
const PAGE = 'More';

export const ACTIONS = [
  { id: 'left', keys: ['ArrowLeft'], shown: '← → ↑ ↓', label: 'look around (Shift: finely)', group: LOOK, run: turn(-5, 0), fine: turn(-1, 0) },
  { id: 'right', keys: ['ArrowRight'], run: turn(5, 0), fine: turn(1, 0) },
  { id: 'up', keys: ['ArrowUp'], run: turn(0, 5), fine: turn(0, 1) },
  { id: 'down', keys: ['ArrowDown'], run: turn(0, -5), fine: turn(0, -1) },
  { id: 'closer', keys: ['+', '='], shown: '+ −', label: 'field of view', group: LOOK, run: zoom(1 / 1.1) },
  { id: 'wider', keys: ['-', '_'], run: zoom(1.1) },
  { id: 'recentre', keys: ['0', 'Home'], label: 'recentre', group: LOOK, run: (player, viewer) => viewer.set({ yaw: 0, pitch: 0, fov: FOV, x: 0, y: 0, z: 0 }) },
  { id: 'turn', keys: ['t'], label: 'turn slowly', group: LOOK, run(player) {
    player.turn();
    return t(player.turning ? 'Turning' : 'Still');
  } },
  { id: 'grid', keys: ['g'], label: 'degrees: grid and numbers', group: LOOK, run(player, viewer) {
    viewer.set({ grid: !viewer.state.grid });
    return t(viewer.state.grid ? 'Grid, every 10 degrees' : 'No grid');
  } },
  { id: 'planet', keys: ['w'], label: 'little planet', group: LOOK, run: planet },
  { id: 'swap', keys: ['s'], label: 'swap the eyes', group: EYES, run(player, viewer) {
    viewer.set({ swap: !viewer.state.swap });
    return t(viewer.state.swap ? 'Eyes swapped' : 'Eyes as in the file');
  } },
  { id: 'mode', keys: ['m'], label: 'next way to show the eyes', group: EYES, run(player, viewer) {
    const at = MODES.indexOf(modeOf(viewer.state.mode));
    return show(viewer, MODES[(at + 1) % MODES.length].name);
  } },
  ...MODES.map((mode, i) => ({
    id: `mode-${mode.name}`, keys: [String(i + 1)], label: mode.label.toLowerCase(), group: EYES, run: (player, viewer) => show(viewer, mode.name),
  })),
  { id: 'farther', keys: [']'], shown: '[ ]', label: 'depth nearer, farther (flat screens)', group: EYES, run: (player, viewer) => converge(viewer, 0.1) },
  { id: 'nearer', keys: ['['], run: (player, viewer) => converge(viewer, -0.1) },
  { id: 'next', keys: ['n', 'PageDown'], label: 'next picture', group: FOLDER, when: isFolder, run: (player, viewer) => viewer.go(1) },
  { id: 'previous', keys: ['p', 'PageUp'], label: 'previous picture', group: FOLDER, when: isFolder, run: (player, viewer) => viewer.go(-1) },
  { id: 'play', keys: [' '], shown: 'Space', label: 'play, pause', group: FILM, when: isFilm, run: film((picture) => picture.toggle()) },
  { id: 'step-back', keys: [','], label: 'previous frame', group: FILM, when: isFilm, run: film((picture) => picture.step(-1)) },
  { id: 'step', keys: ['.'], label: 'next frame', group: FILM, when: isFilm, run: film((picture) => picture.step(1)) },
  { id: 'back', keys: ['j'], label: 'back 5 s', group: FILM, when: isFilm, run: film((picture, video) => picture.seek(video.currentTime - 5)) },
  { id: 'ahead', keys: ['k'], label: 'ahead 5 s', group: FILM, when: isFilm, run: film((picture, video) => picture.seek(video.currentTime + 5)) },
  { id: 'loop', keys: ['l'], label: 'loop', group: FILM, when: isFilm, run: film((picture) => {
    picture.loop(!picture.loops);
    return t(picture.loops ? 'Loop' : 'Play once');
  }) },
  { id: 'sound', keys: ['a'], label: 'sound', group: FILM, when: ({ about }) => about?.kind === 'video', run: film((picture, video) => {
    video.muted = !video.muted;
    return t(video.muted ? 'No sound' : 'Sound');
  }) },
  { id: 'brighter', keys: ['e'], label: 'exposure + ¼ stop', group: FOLDER, when: isLive, run: (player, viewer) => expose(viewer, 0.25) },
  { id: 'darker', keys: ['d'], label: 'exposure − ¼ stop', group: FOLDER, when: isLive, run: (player, viewer) => expose(viewer, -0.25) },
  { id: 'subtitles', keys: ['r'], label: 'subtitles', group: FILM, when: (viewer) => viewer.about?.video?.subtitles, run(player, viewer) {
    const on = viewer.subtitles?.toggle();
    viewer.say('change');
    return t(on ? 'Subtitles' : 'No subtitles');
  } },
  { id: 'list', keys: ['y'], label: 'all pictures', group: FOLDER, when: isFolder, run: (player) => player.toggleList() },
  { id: 'compare', keys: ['x'], label: 'compare with another picture or setting', group: FOLDER, when: (viewer, player) => isPicture(viewer) && !player.isSingle(), run: (player) => player.compare() },
  { id: 'comfort', keys: ['q'], label: 'what strains the eyes', group: FOLDER, when: isJudged, run: (player) => player.comfort() },
  { id: 'link', keys: ['u'], label: 'copy a link to this view', group: PAGE, when: (viewer, player) => player.copyLink, run: (player) => player.copyLink() },
  { id: 'fullscreen', keys: ['f'], label: 'full screen', group: PAGE, run: (player) => player.toggleFullscreen() },
  { id: 'device', keys: [], run: (player) => player.controls.device(), label: 'look by turning this device', group: PAGE, when: hasDevice },
  { id: 'headset', keys: ['v'], label: 'view in the headset', group: PAGE, run: (player) => player.enterHeadset() },
  { id: 'system', keys: [], label: 'the browser’s own player', group: PAGE, when: (viewer) => Boolean(viewer.about?.system) && hasSystemPlayer(), async run(player) {
    (await import('./system-player.js')).showSystemPlayer(player);
  } },
  { id: 'screenshot', keys: ['c'], label: 'save a screenshot', group: PAGE, run: (player) => player.screenshot() },
  { id: 'settings', keys: ['o'], label: 'settings', group: PAGE, run: (player) => player.toggleSettings() },
  { id: 'help', keys: ['?', 'h'], label: 'help', group: PAGE, run: (player) => player.help() },
];

export const applies = ({ id, when }, player) => !player.viewer.picture?.lacks?.includes(id) && (!when || Boolean(when(player.viewer, player)));

// The actions that apply now: those of the open picture first.
export const actionsOf = (player) => [...(player.viewer.picture?.actions ?? []), ...ACTIONS].filter((action) => applies(action, player));

// The present action of a key.
export const actionOf = (key, player) => actionsOf(player).find((action) => action.keys.includes(key));

const SHOWN = { PageDown: 'Page ↓', PageUp: 'Page ↑' };
export const keysOf = (action) => (action.shown?.split(' ') ?? action.keys).map((key) => SHOWN[key] ?? (key.length > 1 ? key : key.toUpperCase()));
