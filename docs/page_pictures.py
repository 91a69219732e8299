#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/images/view.jpg and docs/images/studio.jpg: the page of ods view with a picture, and with a scene when its
picture is finished, or after half an hour.

  docs/page_pictures.py atrium_360_TB.jpg '#yaw=12&pitch=4' atrium.glb '#yaw=12&pitch=4'

Needs build/release/ods, chromium (or chromium-headless-shell) and oiiotool.
"""
import base64
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

PATIENCE = 1800  # seconds
SHOWN = "window.omnistereo?.viewer.picture && !omnistereo.viewer.picture.isPreview"
FINISHED = "document.body.innerText.includes(': finished')"
# Without the hint; with the bar, which fades otherwise.
AWAKE = "getComputedStyle(document.getElementById('bar')).opacity === '1'"
PLAIN = "for (const name of ['pointerdown', 'pointermove']) document.dispatchEvent(new Event(name, { bubbles: true }));"
OPEN = PLAIN + "omnistereo.viewer.set({ mode: 'side-by-side', grid: true }); omnistereo.act('settings')"


class Browser:
    """Chromium, told what to do through a pair of pipes: JSON with a zero byte behind each message."""

    def __init__(self, profile):
        program = shutil.which("chromium") or shutil.which("chromium-headless-shell")
        theirs, self.out = os.pipe()
        self.into, other = os.pipe()

        def connect():  # it reads from 3 and writes to 4
            os.dup2(theirs, 100), os.dup2(other, 101)
            os.dup2(100, 3), os.dup2(101, 4)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--ignore-gpu-blocklist", "--hide-scrollbars", "--remote-debugging-pipe", f"--user-data-dir={profile}"],
            close_fds=False, preexec_fn=connect, stderr=subprocess.DEVNULL)
        self.count, self.text = 0, b""

    def ask(self, method, session=None, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.text:
                piece = os.read(self.into, 1 << 20)
                if not piece:
                    raise SystemExit("the browser has ended")
                self.text += piece
            line, self.text = self.text.split(b"\0", 1)
            answer = json.loads(line)
            if answer.get("id") == self.count:
                return answer["result"]


# is_ready: in the page's words; then what: it does.
def take_picture(browser, address, is_ready, what):
    target = browser.ask("Target.createTarget", url="about:blank")["targetId"]
    session = browser.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    browser.ask("Emulation.setDeviceMetricsOverride", session, width=1280, height=720, deviceScaleFactor=1, mobile=False)
    dark = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.ask("Emulation.setEmulatedMedia", session, features=dark)
    browser.ask("Page.navigate", session, url=address)
    end = time.monotonic() + PATIENCE
    while not browser.ask("Runtime.evaluate", session, expression=is_ready)["result"].get("value") and time.monotonic() < end:
        time.sleep(1)
    browser.ask("Runtime.evaluate", session, expression=what)
    while not browser.ask("Runtime.evaluate", session, expression=AWAKE)["result"].get("value"):
        browser.ask("Runtime.evaluate", session, expression=PLAIN)
        time.sleep(0.2)  # it comes while a software GPU is busy
    return base64.b64decode(browser.ask("Page.captureScreenshot", session)["data"])


def make(image, shown, look, is_ready, what):
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    where, name = os.path.split(os.path.abspath(shown))
    server = subprocess.Popen([root + "/build/release/ods", "view", name, "--no-browser"], cwd=where,
                              stdout=subprocess.PIPE, text=True)
    with tempfile.TemporaryDirectory() as folder:
        browser = None
        try:
            address = next(found.group() for line in server.stdout if (found := re.search(r"http://\S+", line)))
            browser = Browser(folder + "/profile")
            with open(folder + "/page.png", "wb") as file:
                file.write(take_picture(browser, address + look, is_ready, what))
            subprocess.run(["oiiotool", folder + "/page.png", "--ch", "R,G,B", "--compression", "jpeg:90", "-d", "uint8",
                            "-o", f"{root}/docs/images/{image}"], check=True)
        finally:
            for process in (browser and browser.process, server):
                if process:
                    process.terminate(), process.wait()


make("view.jpg", sys.argv[1], sys.argv[2], SHOWN, OPEN)
make("studio.jpg", sys.argv[3], sys.argv[4], FINISHED, PLAIN)
