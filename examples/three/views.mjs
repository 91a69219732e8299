// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders the views of a rig with a three.js page in headless Chromium, and writes them to files.
//
//   node views.mjs PAGE.html [FOLDER [FIRST LAST]]     FOLDER: views. FIRST, LAST: the range of views, for a farm
//
// Serves only the page's own folder to it. Requests of the page:
//   PUT  /views/0001.png   a file into FOLDER (ods-rig.txt, too); written atomically
//   POST /end              the end; a body is an error message
// The page gets ?first=FIRST&last=LAST. CHROMIUM is the browser, if it has none of the usual names.
import { spawn, spawnSync } from "node:child_process";
import { createReadStream, existsSync, mkdirSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { basename, dirname, extname, join, resolve, sep } from "node:path";

const browsers = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"];
const script = "text/javascript";
const types = { ".html": "text/html", ".js": script, ".mjs": script, ".json": "application/json" };
const patience = 300; // seconds without a request from the page

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

// Without a graphics card Chromium renders with its own SwiftShader, which needs a flag. It is a group of processes,
// possibly started by a script.
function open(program, profile, url) {
  const words = ["--headless", "--ignore-gpu-blocklist", "--enable-unsafe-swiftshader", `--user-data-dir=${profile}`];
  if (process.getuid?.() === 0) words.push("--no-sandbox"); // otherwise it refuses to run as root
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
