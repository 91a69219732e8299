// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Subtitles of a video: the text of a WebVTT file, given as video.subtitles in view.json. The browser reads it; the
// current text is shown above the bar. Returns a function that switches them.
export function showSubtitles({ viewer, root }) {
  const line = document.createElement('p');
  line.id = 'subtitles';
  line.hidden = true;
  root.getElementById('foot').prepend(line);
  let on = true;
  let track = null;
  const show = () => {
    const cues = on ? [...(track?.activeCues ?? [])] : [];
    line.textContent = cues.map((cue) => cue.getCueAsHTML().textContent).join('\n');
    line.hidden = !line.textContent;
  };
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
  return (is = !on) => {
    on = is;
    show();
    return on;
  };
}
