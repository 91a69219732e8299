// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The start of a bundle (ods/view/bundle.h), with $base, its own address, before it, and $rare, which names the script
// of each module that is in another one than later.js; and the modules after it. Browsers do not let a page from disk
// read files, so it gets a file from the script FILE.js beside it.
const $modules = {};
const $later = {};

const $script = (file) => new Promise((done, fail) => {
  const script = Object.assign(document.createElement('script'), { src: new URL(`${file}.js`, $base) });
  script.onload = () => done(window.omnistereoLater);
  script.onerror = () => fail(new Error(`A part of this page did not load: ${file}.js. Is the server still running?`));
  document.head.append(script);
});

// Some modules are in separate scripts (ods/view/bundle.h); of a module they are modules, by $bring.
async function $load(name) {
  if ($modules[name]) return $modules[name];
  const file = $rare[name] ?? 'later';
  $later[file] ??= (typeof $bring === 'undefined' ? $script(file) : $bring[file]().then(({ later }) => later)).then((later) => later($modules, $load, $base, fetch));
  await $later[file].catch((error) => {
    $later[file] = null; // the next call tries again
    throw error;
  });
  return $modules[name];
}

async function fetch(address, options) {
  const url = new URL(address, document.baseURI);
  if (url.protocol !== 'file:') return window.fetch(address, options);
  const given = (window.stereo360Files ??= {}); // by address: base64
  url.search = url.hash = '';
  if (!given[url.href]) {
    const script = Object.assign(document.createElement('script'), { src: `${url.href}.js` });
    await new Promise((done) => {
      script.onload = script.onerror = done;
      document.head.append(script);
    });
    script.remove();
  }
  if (!given[url.href]) {
    const why = 'browsers let no page from disk read it: ods view FILE --export FOLDER makes a copy that they read, or a web server can have it';
    return new Response(why, { status: 404, headers: { 'content-type': 'text/plain' } });
  }
  const answer = await window.fetch(given[url.href]);
  delete given[url.href];
  return answer;
}
