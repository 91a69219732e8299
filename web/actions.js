// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that a key or a button of the page does: one table, from which the help is made, too. A row has its id for
// buttons, its keys as KeyboardEvent.key says them, its words for people, and where only some items have it, `when`.
// run(page, viewer) may return what to say in a few words.
import { MODES, modeOf } from './modes.js';

const turn = (yaw, pitch) => (page, viewer) =>
  viewer.set({ yaw: viewer.state.yaw + yaw, pitch: viewer.state.pitch + pitch });
const zoom = (by) => (page, viewer) => viewer.set({ fov: viewer.state.fov * by });
const film = (run) => (page, viewer) => viewer.picture?.video && run(viewer.picture, viewer.picture.video);
const isFilm = (viewer) => viewer.about?.kind === 'video';
const isLive = (viewer) => viewer.about?.live;
const isFolder = (viewer) => viewer.view.items.length > 1;

function show(viewer, name) {
  viewer.set({ mode: name });
  return modeOf(name).label;
}

function expose(viewer, by) {
  viewer.expose(by);
  return `Exposure ${viewer.choice.exposure} stops`;
}

export const ACTIONS = [
  { id: 'left', keys: ['ArrowLeft'], shown: '← → ↑ ↓', label: 'look around (Shift: finely)', run: turn(-5, 0), fine: turn(-1, 0) },
  { id: 'right', keys: ['ArrowRight'], run: turn(5, 0), fine: turn(1, 0) },
  { id: 'up', keys: ['ArrowUp'], run: turn(0, 5), fine: turn(0, 1) },
  { id: 'down', keys: ['ArrowDown'], run: turn(0, -5), fine: turn(0, -1) },
  { id: 'closer', keys: ['+', '='], shown: '+ −', label: 'field of view', run: zoom(1 / 1.1) },
  { id: 'wider', keys: ['-', '_'], run: zoom(1.1) },
  { id: 'recentre', keys: ['0', 'Home'], label: 'recentre', run: (page, viewer) => viewer.set({ yaw: 0, pitch: 0, fov: page.fov() }) },
  { id: 'swap', keys: ['s'], label: 'swap the eyes', run(page, viewer) {
    viewer.set({ swap: !viewer.state.swap });
    return viewer.state.swap ? 'Eyes swapped' : 'Eyes as in the file';
  } },
  { id: 'mode', keys: ['m'], label: 'next way to show the eyes', run(page, viewer) {
    const at = MODES.indexOf(modeOf(viewer.state.mode));
    return show(viewer, MODES[(at + 1) % MODES.length].name);
  } },
  ...MODES.map((mode, i) => ({
    id: `mode-${mode.name}`, keys: [String(i + 1)], label: mode.label.toLowerCase(), run: (page, viewer) => show(viewer, mode.name),
  })),
  { id: 'grid', keys: ['g'], label: 'grid of degrees', run(page, viewer) {
    viewer.set({ grid: !viewer.state.grid });
    return viewer.state.grid ? 'Grid, every 10 degrees' : 'No grid';
  } },
  { id: 'next', keys: ['n', 'PageDown'], label: 'next picture', when: isFolder, run: (page, viewer) => viewer.go(1) },
  { id: 'previous', keys: ['p', 'PageUp'], label: 'previous picture', when: isFolder, run: (page, viewer) => viewer.go(-1) },
  { id: 'play', keys: [' '], shown: 'Space', label: 'play, pause', when: isFilm, run: film((picture) => picture.toggle()) },
  { id: 'step-back', keys: [','], label: 'previous frame', when: isFilm, run: film((picture) => picture.step(-1)) },
  { id: 'step', keys: ['.'], label: 'next frame', when: isFilm, run: film((picture) => picture.step(1)) },
  { id: 'back', keys: ['j'], label: 'back 5 s', when: isFilm, run: film((picture, video) => picture.seek(video.currentTime - 5)) },
  { id: 'ahead', keys: ['k'], label: 'ahead 5 s', when: isFilm, run: film((picture, video) => picture.seek(video.currentTime + 5)) },
  { id: 'loop', keys: ['l'], label: 'loop', when: isFilm, run: film((picture) => {
    picture.loop(!picture.loops);
    return picture.loops ? 'Loop' : 'Play once';
  }) },
  { id: 'sound', keys: ['a'], label: 'sound', when: isFilm, run: film((picture, video) => {
    video.muted = !video.muted;
    return video.muted ? 'No sound' : 'Sound';
  }) },
  { id: 'brighter', keys: ['e'], label: 'exposure + ¼ stop', when: isLive, run: (page, viewer) => expose(viewer, 0.25) },
  { id: 'darker', keys: ['d'], label: 'exposure − ¼ stop', when: isLive, run: (page, viewer) => expose(viewer, -0.25) },
  { id: 'fullscreen', keys: ['f'], label: 'full screen', run: () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else document.documentElement.requestFullscreen?.().catch(() => {});
  } },
  { id: 'headset', keys: ['v'], label: 'view in the headset', run: (page) => page.enterHeadset() },
  { id: 'screenshot', keys: ['c'], label: 'save a screenshot', run: (page) => page.screenshot() },
  { id: 'settings', keys: ['o'], label: 'settings', run: (page) => page.toggleSettings() },
  { id: 'help', keys: ['?', 'h'], label: 'this help', run: (page) => page.help() },
];

const SHOWN = { PageDown: 'Page ↓', PageUp: 'Page ↑' };
export const keysOf = (action) => (action.shown?.split(' ') ?? action.keys).map((key) => SHOWN[key] ?? (key.length > 1 ? key : key.toUpperCase()));
