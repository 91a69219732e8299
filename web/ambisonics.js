// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// First-order ambisonic sound (AmbiX: W Y Z X, SN3D) for two ears: eight fixed loudspeakers at the corners of a cube,
// heard through the browser's own head-related filters by a listener who turns.
//
// A loudspeaker in direction d plays (W + 3 g d.(X, Y, Z)) / 8, which puts a wave's energy into its direction; g is 1 /
// sqrt(3) (max-rE of the first order in three dimensions: Daniel, Representation de champs acoustiques, 2001).
import { raysOfView } from './headset.js';
import { raysOf } from './panorama.js';

const SPEAKERS = 8;
const FIRST = Math.sqrt(3); // 3 g
const CORNERS = Array.from({ length: SPEAKERS }, (_, i) => [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1].map((side) => side / Math.sqrt(3)));

// source: a node with four channels. Returns look(ahead, up), which turns the listener.
export function listen(context, source) {
  const channels = context.createChannelSplitter(4);
  source.connect(channels);
  for (const [x, y, z] of CORNERS) { // WebAudio's own axes: x to the right, y up, z to the back
    const speaker = new PannerNode(context, { panningModel: 'HRTF', distanceModel: 'linear', rolloffFactor: 0, positionX: x, positionY: y, positionZ: z });
    for (const [channel, part] of [1, -x * FIRST, y * FIRST, -z * FIRST].entries()) { // W, Y to the left, Z up, X ahead
      const gain = new GainNode(context, { gain: part / SPEAKERS });
      channels.connect(gain, channel).connect(speaker);
    }
    speaker.connect(context.destination);
  }
  const { listener } = context;
  return (ahead, up) => {
    if (!listener.forwardX) return listener.setOrientation(...ahead, ...up); // Firefox
    for (const [name, values] of [['forward', ahead], ['up', up]]) ['X', 'Y', 'Z'].forEach((axis, i) => (listener[name + axis].value = values[i]));
  };
}

// Plays videos with ambisonic sound in this way; other sound is not changed.
export function hearVideos({ viewer, headset }) {
  let turn = null;
  let context = null;
  const follow = () => {
    if (!turn) return;
    if (context.state === 'suspended' && !viewer.picture?.video?.paused) context.resume();
    const { session, state } = viewer;
    const axes = session && headset.pose ? raysOfView(headset.pose.views[0], headset.turn) : raysOf(state, 1);
    turn(axes.slice(6, 9), axes.slice(3, 6));
    if (session) session.requestAnimationFrame(follow);
  };
  const open = () => {
    turn = null;
    context?.close();
    context = null;
    const { picture, about } = viewer;
    if (!picture?.video || about.video?.sound !== 'ambix') return;
    context = new AudioContext();
    turn = listen(context, context.createMediaElementSource(picture.video));
    follow();
  };
  for (const event of ['open', 'sleep']) viewer.addEventListener(event, open);
  viewer.addEventListener('change', follow);
  open();
}
