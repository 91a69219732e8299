// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Subtitles of a video: the text of a WebVTT file, given as video.subtitles in view.json. The browser reads it; the
// current text is shown above the bar, and in the headset, which finds it in viewer.subtitles: { text, isOn, toggle() }.
export function showSubtitles({ viewer, root }) {
  const line = document.createElement('p');
  line.id = 'subtitles';
  line.hidden = true;
  root.getElementById('foot').prepend(line);
  let track = null;
  const show = () => {
    const cues = state.isOn ? [...(track?.activeCues ?? [])] : [];
    state.text = line.textContent = cues.map((cue) => cue.getCueAsHTML().textContent).join('\n');
    line.hidden = !state.text;
  };
  const state = (viewer.subtitles = {
    text: '', isOn: true,
    toggle() {
      state.isOn = !state.isOn;
      show();
      return state.isOn;
    },
  });
  const open = () => {
    const { picture, about } = viewer;
    track = null;
    show();
    if (!picture?.video || !about.video?.subtitles) return;
    const address = URL.createObjectURL(new Blob([about.video.subtitles], { type: 'text/vtt' }));
    const element = Object.assign(document.createElement('track'), { kind: 'subtitles', src: address });
    element.addEventListener('load', () => URL.revokeObjectURL(address));
    picture.video.append(element);
    track = element.track;
    track.mode = 'hidden'; // read, but not drawn by the browser
    track.addEventListener('cuechange', show);
  };
  viewer.addEventListener('open', open);
  open();
}
