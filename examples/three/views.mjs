// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Has a page that draws by three.js take the views of a rig in Chromium without a window, and writes them to files.
//
//   node views.mjs PAGE.html [FOLDER [FIRST LAST]]     FOLDER: views. FIRST, LAST: the views, for a farm
//
// The page's own folder is served to it, and nothing else of the disk. From the page:
//   PUT  /views/0001.png   a file into FOLDER (ods-rig.txt, too); it appears complete or not at all
//   POST /end              the end: of what went well without words, else what went wrong
// ?first=FIRST&last=LAST is what the page is told. CHROMIUM is the browser, if none of the usual names is one.
import { spawn, spawnSync } from "node:child_process";
import { createReadStream, existsSync, mkdirSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { basename, dirname, extname, join, resolve, sep } from "node:path";

const browsers = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"];
const script = "text/javascript";
const types = { ".html": "text/html", ".js": script, ".mjs": script, ".json": "application/json" };
const patience = 300; // seconds without a word from the page

const [page, folder = "views", first, last] = process.argv.slice(2);
if (!page || (first && !last)) stop(2, "node views.mjs PAGE.html [FOLDER [FIRST LAST]]");
if (!existsSync(page)) stop(3, `there is no '${page}'`);
const root = resolve(dirname(page));

function stop(status, words) {
  console.error("views: " + words);
  process.exit(status);
}

function body(request) {
  return new Promise((done, failed) => {
    const parts = [];
    request.on("data", (part) => parts.push(part));
    request.on("end", () => done(Buffer.concat(parts)));
    request.on("error", failed);
  });
}

async function take(name, request) {
  const bytes = await body(request), path = join(folder, name);
  if (name === "ods-rig.txt" && existsSync(path) && !readFileSync(path).equals(bytes)) {
    throw new Error(`${path}: views of another rig. Remove the folder, or name another one`);
  }
  const unfinished = join(folder, `.unfinished.${process.pid}.${name}`);
  writeFileSync(unfinished, bytes);
  renameSync(unfinished, path);
  console.log(path);
}

function send(path, response, ended) {
  const file = resolve(root, "." + path);
  if (!file.startsWith(root + sep) || !existsSync(file)) {
    response.writeHead(404).end();
    if (path !== "/favicon.ico") ended(`the page asks for ${path}, and there is none in ${root}`);
    return;
  }
  response.writeHead(200, { "Content-Type": types[extname(file)] ?? "application/octet-stream" });
  createReadStream(file).on("error", () => response.destroy()).pipe(response);
}

async function answer(request, response, ended) {
  const path = decodeURIComponent(new URL(request.url, "http://page").pathname);
  const view = /^\/views\/([\w-]+\.(?:png|txt))$/.exec(path);
  if (request.method === "PUT" && view) await take(view[1], request);
  else if (request.method === "POST" && path === "/end") ended((await body(request)).toString());
  else if (request.method === "GET") return send(path, response, ended);
  response.writeHead(200).end();
}

function browser() {
  const names = process.env.CHROMIUM ? [process.env.CHROMIUM] : browsers;
  const found = names.find((name) => spawnSync(name, ["--version"]).status === 0);
  if (!found) stop(3, `no browser: ${names.join(", ")}; set CHROMIUM, or install chromium`);
  return found;
}

// Without a graphics card Chromium draws by its own SwiftShader, which it has to be allowed. It is a group of
// processes, before which a script may stand.
function open(program, profile, url) {
  const words = ["--headless", "--ignore-gpu-blocklist", "--enable-unsafe-swiftshader", `--user-data-dir=${profile}`];
  if (process.getuid?.() === 0) words.push("--no-sandbox"); // it refuses root otherwise
  return spawn(program, [...words, url], { stdio: "ignore", detached: true });
}

function main() {
  const program = browser();
  const profile = mkdtempSync(join(tmpdir(), "views-"));
  mkdirSync(folder, { recursive: true });
  let child, clock;
  const end = (fault) => {
    clearTimeout(clock);
    child.removeAllListeners("exit");
    child.once("exit", () => {
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
      fault ? stop(1, fault) : process.exit(0);
    });
    process.kill(-child.pid, "SIGKILL");
  };
  const wait = () => {
    clearTimeout(clock);
    clock = setTimeout(() => end(`the page said nothing for ${patience} seconds`), 1000 * patience);
  };
  const server = createServer((request, response) => {
    wait();
    answer(request, response, end).catch((error) => {
      response.writeHead(500).end();
      end(error.message);
    });
  });
  server.listen(0, "127.0.0.1", () => {
    const range = first ? `?first=${Number(first)}&last=${Number(last)}` : "";
    const url = `http://127.0.0.1:${server.address().port}/${encodeURIComponent(basename(page))}${range}`;
    child = open(program, profile, url);
    child.once("exit", (status) => stop(1, `${program} ended by itself, with ${status}`));
    for (const signal of ["SIGINT", "SIGTERM"]) process.once(signal, () => end("interrupted"));
    wait();
  });
}

main();
