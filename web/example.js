// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The third example of example.html.
const panorama = document.getElementById('scripted');
panorama.addEventListener('look', ({ detail }) => {
  document.getElementById('where').textContent = `yaw ${detail.yaw.toFixed(0)}°, pitch ${detail.pitch.toFixed(0)}°`;
});
for (const button of document.querySelectorAll('[data-yaw]')) {
  button.addEventListener('click', () => panorama.lookAt({ yaw: Number(button.dataset.yaw), pitch: 0 }));
}
