// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
const worn = document.getElementById('worn');
document.getElementById('enter').addEventListener('click', () => {
  document.getElementById('said').textContent = navigator.xr ? '' : 'This browser knows no headset.';
  worn.enterHeadset();
});
