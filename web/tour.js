// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The guide through a picture's hotspots, and through a tour if view.json has one (docs/view.md): the spots of the open
// picture, what they tell, and where they lead. It is viewer.guide, for the desk (notes.js, tour-plan.js) and the headset
// (tour-worn.js, headset-guide.js). Events: `spots` (another picture has others), `tell` (a card opened or closed).
import { wrapDegrees } from './geometry.js';
import { itemName } from './item-name.js';
import { showNotes } from './notes.js';
import { showPlan } from './tour-plan.js';
import { STYLE } from './tour-style.js';
import { headingOf, pixelOf, placesOf, pointAt, turnTo, waysOf } from './tour-ways.js';
import { WornSpots } from './tour-worn.js';

const NEXT = 4; // panoramas that are fetched ahead
const READ = { text: 3000, letter: 60 }; // milliseconds to read it

class Guide extends EventTarget {
  constructor(player) {
    super();
    const { viewer } = player;
    const { tour } = viewer.view;
    Object.assign(this, { viewer, tour, ways: tour && waysOf(tour), spots: [], open: null, item: -1, text: '', read: READ, worn: null });
    this.dots = tour?.plan && placesOf(tour).map((place) => place && pixelOf(tour.plan, place));
    viewer.addEventListener('open', () => this.opened());
  }

  say(name) {
    this.dispatchEvent(new Event(name));
  }

  titleOf(i) {
    return itemName(this.viewer.view.items[i]);
  }

  // The picture is another one, or the same again with another layout or exposure.
  opened() {
    const { viewer, item: from } = this;
    const { item, about } = viewer;
    if (item === from) return;
    this.item = item;
    if (this.tour && from >= 0 && item >= 0) this.turn(turnTo(this.tour, this.ways, from, item));
    const notes = (about?.hotspots ?? []).map((spot, i) => {
      const entry = { ...spot, number: i + 1, at: pointAt(spot, spot.distance ?? 2.5) };
      return Object.assign(entry, { run: () => this.tell(entry) });
    });
    const ways = (this.ways?.[item] ?? []).map((way) => ({ ...way, title: this.titleOf(way.to), run: () => this.go(way.to) }));
    Object.assign(this, { spots: [...ways, ...notes], open: null });
    this.show(this.told);
    this.say('spots');
  }

  // The title of a tour's panorama, and its text.
  get told() {
    const { viewer: { item, about }, tour } = this;
    return [tour && this.titleOf(item), about?.caption].filter(Boolean).join('\n');
  }

  // Looks farther to the right, by degrees.
  turn(by) {
    const { viewer, worn } = this;
    if (worn) worn.headset.turnBy(by);
    viewer.set({ yaw: viewer.state.yaw + by });
  }

  go(item) {
    return this.viewer.open(item, this.viewer.lasting());
  }

  // Opens a spot's card, or closes it.
  tell(spot) {
    this.open = spot === this.open ? null : spot;
    this.show(this.open ? [spot.title, spot.text].filter(Boolean).join('\n') : '');
    this.say('tell');
  }

  // Shows a text in the headset, until it can have been read.
  show(text) {
    this.text = text;
    clearTimeout(this.reading);
    this.reading = setTimeout(() => (this.text = ''), this.read.text + this.read.letter * text.length);
  }

  // The heading of the view, 0 to 360 degrees; null where it is unknown.
  get heading() {
    const here = this.tour?.panoramas[this.item]; // the viewer's item may still load
    const heading = here && headingOf(here);
    return heading === undefined ? null : (wrapDegrees(heading + this.viewer.state.yaw) + 360) % 360;
  }

  north() {
    this.viewer.set({ yaw: -headingOf(this.tour.panoramas[this.item]) });
  }

  // The items that a visitor is likely to open next.
  next() {
    return this.ways?.[this.item]?.slice(0, NEXT).map(({ to }) => to);
  }

  // --- in the headset ---

  wear(panel) {
    this.show(this.told);
    return (this.worn = new WornSpots(this, panel));
  }

  tellAgain(panel) {
    panel.close();
    this.show(this.told);
  }
}

export function showTour(player) {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  player.root.adoptedStyleSheets = [...player.root.adoptedStyleSheets, sheet];
  const guide = (player.viewer.guide = new Guide(player));
  showNotes(player.viewer, guide);
  if (guide.tour) showPlan(player, guide);
  if (player.viewer.picture) guide.opened();
}

// Returns the view of a tour.json, for <stereo-360 tour>: { items, tour }. itemOf(address) makes an item of a file. Throws
// an Error of one line.
export function readTour(tour, address, itemOf) {
  const fail = (what) => {
    throw new Error(`${address.pathname.split('/').pop()}: ${what}`);
  };
  if (!Array.isArray(tour?.panoramas) || !tour.panoramas.length) fail('it has no list of panoramas');
  const nameOf = (file) => file.split('/').pop().replace(/\.\w+$/, '').replace(/_(360|180).*/, '');
  const panoramas = tour.panoramas.map((each, i) => {
    const entry = typeof each === 'string' ? { file: each } : { ...each };
    if (!entry.file) fail(`panoramas.${i} has no file`);
    return Object.assign(entry, { name: entry.name ?? nameOf(entry.file), title: entry.title ?? nameOf(entry.file) });
  });
  const names = panoramas.map(({ name }) => name);
  panoramas.forEach(({ name, links, place, on_plan: pixel }, i) => {
    if (names.indexOf(name) !== i) fail(`two panoramas are called '${name}'`);
    for (const link of links ?? []) if (!names.includes(link.to ?? link)) fail(`panoramas.${i} leads to '${link.to ?? link}', which is not the name of a panorama`);
    if (!links && names.length > 1 && !place && !(pixel && tour.plan)) fail(`panoramas.${i} ('${name}') has neither a place nor links`);
  });
  const url = (file) => new URL(file, address).href;
  const items = panoramas.map(({ file, title, text, hotspots }) => ({ ...itemOf(url(file)), title, caption: text, hotspots }));
  return { items, tour: { ...tour, panoramas, plan: tour.plan && { ...tour.plan, image: url(tour.plan.image) } } };
}
