// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The texts in the language of the page, <html lang>. The code has them in English, translations-de.js and
// translations-fr.js have their translations. A text that is missing there stays English.
export const LANGUAGES = { de: () => import('./translations-de.js'), fr: () => import('./translations-fr.js') };

let translations = {};

// Loads the page's language, before elements with texts are made. Where its script is missing, the texts are English.
export async function useLanguage() {
  const code = document.documentElement.lang.slice(0, 2).toLowerCase();
  translations = (await LANGUAGES[code]?.().catch(() => null))?.TRANSLATIONS ?? {};
}

// Returns the translation of a text, in which each {} is replaced by the next value.
export function t(text, ...values) {
  let i = 0;
  return (translations[text] ?? text).replace(/\{\}/g, () => values[i++]);
}
