// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The ways of a tour from the places of its panoramas (docs/view.md). Metres; the world is glTF's: x to the right, y up,
// z back; headings are degrees to the right of -Z. A spot is relative to the middle between the eyes, in the picture's
// frame: `at` is its sign, `foot` the place below it on the floor, or null.
import { clamp, degrees, radians } from './geometry.js';

const REACH = [1.5, 4]; // metres to a sign, along the floor: near enough to be seen, and comfortable for both eyes
const USUAL = 2.5; // metres, where there are no places
const SIGN = 0.9; // metres above the floor
const HEIGHT = 1.6; // metres of a camera above the floor
export const RING = 0.35; // metres: radius of the ring around the foot of a sign

// Returns a point at a distance along a heading, at a height.
const along = (heading, way, y) => [way * Math.sin(radians(heading)), y, -way * Math.cos(radians(heading))];

// The point of a direction { yaw, pitch } at a distance.
export function pointAt({ yaw = 0, pitch = 0 }, distance) {
  const p = radians(pitch);
  return along(yaw, distance * Math.cos(p), distance * Math.sin(p));
}

// The axes of a plan in the world (x, z): its right and its upper direction.
const axesOf = ({ heading = 0 }) => [[Math.cos(radians(heading)), Math.sin(radians(heading))], [Math.sin(radians(heading)), -Math.cos(radians(heading))]];

// Returns the pixel of a place on a plan.
export function pixelOf(plan, [x, , z]) {
  const { metres_per_pixel: size, origin: [left, top] = [0, 0] } = plan;
  const [right, up] = axesOf(plan).map((axis) => (x * axis[0] + z * axis[1]) / size);
  return [left + right, top - up];
}

// Returns the place of each panorama, or null: of the file, or by its pixel on the plan.
export function placesOf({ panoramas, plan, height = HEIGHT, floor = 0 }) {
  return panoramas.map(({ place, on_plan: pixel, floor: own = floor }) => {
    if (place || !pixel || !plan) return place ?? null;
    const { metres_per_pixel: size, origin: [left, top] = [0, 0] } = plan;
    const [right, up] = axesOf(plan);
    const [a, b] = [(pixel[0] - left) * size, (top - pixel[1]) * size];
    return [a * right[0] + b * up[0], own + height, a * right[1] + b * up[1]];
  });
}

const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

// Returns for each place the numbers of its neighbours: two places are neighbours if no third one is nearer to both
// (the relative neighbourhood graph, Toussaint 1980), so every place can be reached.
export function neighboursOf(places) {
  const isFree = (i, k) => places.every((other, j) => !other || j === i || j === k
    || Math.max(distance(other, places[i]), distance(other, places[k])) >= distance(places[i], places[k]));
  return places.map((place, i) => (place ? [...places.keys()].filter((k) => k !== i && places[k] && isFree(i, k)) : []));
}

// The sign of a way along the floor.
function signOn(yaw, reach, floor) {
  const [foot, at] = [floor, floor + SIGN].map((y) => along(yaw, reach, y));
  return { at, foot };
}

// Returns the ways from each panorama: [{ to, at, foot, yaw }].
export function waysOf(tour) {
  const { panoramas, floor = 0, height = HEIGHT } = tour;
  const places = placesOf(tour);
  const neighbours = neighboursOf(places);
  const heights = panoramas.map(({ floor: own = floor }, i) => (places[i] ? places[i][1] - own : height));
  const number = (name) => panoramas.findIndex((each) => each.name === name);
  return panoramas.map((panorama, i) => {
    const { heading = 0, links = neighbours[i].map((k) => ({ to: panoramas[k].name })) } = panorama;
    return links.map((link) => {
      const { to, yaw, pitch, distance: far } = typeof link === 'string' ? { to: link } : link;
      const k = number(to);
      const by = places[i] && places[k] && places[k].map((x, axis) => x - places[i][axis]);
      const way = by && Math.hypot(by[0], by[2]);
      const turn = yaw ?? (way > 0 ? degrees(Math.atan2(by[0], -by[2])) - heading : 0);
      if (pitch !== undefined) return { to: k, yaw: turn, at: pointAt({ yaw: turn, pitch }, far ?? USUAL), foot: null };
      const reach = far ?? (by ? clamp(way, ...REACH) : USUAL);
      const climbs = by ? by[1] - heights[k] + heights[i] : 0; // from floor to floor
      return { to: k, yaw: turn, ...signOn(turn, reach, climbs * Math.min(1, reach / Math.max(way ?? reach, 1e-6)) - heights[i]) };
    });
  });
}

// The heading of a panorama's middle; where there is a place, 0 if it has none.
export const headingOf = ({ heading, place, on_plan: pixel }) => heading ?? (place || pixel ? 0 : undefined);

// Returns by how much the yaw in one panorama is larger than that of the same heading in another, degrees. If their
// headings are unknown, by the ways that lead from each to the other; else 0.
export function turnTo({ panoramas }, ways, from, to) {
  const [a, b] = [from, to].map((i) => headingOf(panoramas[i]));
  if (a !== undefined && b !== undefined) return a - b;
  const there = ways[from].find((way) => way.to === to);
  const back = ways[to].find((way) => way.to === from);
  return there && back ? back.yaw + 180 - there.yaw : 0;
}

// The part of the eyes' distance that a merge leaves at an elevation, nearly: of a curve, the chord.
function shareOf({ mode = 0, start, end } = {}, elevation) {
  return mode > 0 && start < end ? clamp((end - elevation) / (end - start), 0, 1) : 1;
}

// Returns the direction { yaw, pitch } in which an eye of a panorama shows a point: the eyes look along tangents of the
// viewing circle, so to a point at the distance d along the floor the left eye looks asin(r / d) farther to the right.
// side: 1 for the left eye, -1 for the right one, 0 for the middle between both.
export function seenBy(side, [x, y, z], { ipd = 0.065, top, bottom } = {}) {
  const way = Math.hypot(x, z);
  const radius = 0.5 * ipd * shareOf(y > 0 ? top : bottom, Math.abs(Math.atan2(y, way)));
  const free = Math.sqrt(Math.max(way * way - side * side * radius * radius, 0));
  return { yaw: degrees(Math.atan2(x, -z) + Math.atan2(side * radius, free)), pitch: degrees(Math.atan2(y, free)) };
}
