// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults in words for visitors, who cannot mend them: the page's author finds the reason in the console.
import { t } from './translate.js';

export function forVisitors(reason) {
  console.warn(`stereo-360: ${reason}`);
  return t(/WebGL/.test(reason) ? 'Your browser cannot show this panorama. A newer one can.'
    : /did not load|broke/.test(reason) ? 'This panorama did not load. Check your connection.' : 'This panorama cannot be shown.');
}
