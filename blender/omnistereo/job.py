# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""The command ods, running for the add-on."""
import json
import os
import shutil
import subprocess
import tempfile
import threading


class Job:
    """One run of ods. Its lines of JSON (docs/console.md) are read by a thread."""

    def __init__(self, words, folder):
        self.words, self.folder = words, folder
        self.share, self.line, self.error = 0.0, "", ""
        self.warnings, self.code, self.cancelled = [], None, False
        self.process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE, text=True, errors="replace")
        self.thread = threading.Thread(target=self._read, daemon=True)
        self.thread.start()

    def _read(self):
        for line in self.process.stderr:
            self._take(line)
        self.code = self.process.wait()
        if self.code == 0:
            self.share = 1.0
        shutil.rmtree(self.folder, ignore_errors=True)

    def _take(self, line):
        try:
            said = json.loads(line)
        except ValueError:
            return
        if not isinstance(said, dict):
            return
        self.share = said.get("progress", self.share)
        self.line = said.get("note", self.line)
        self.error = said.get("error", self.error)
        if "warning" in said and said["warning"] not in self.warnings:
            self.warnings.append(said["warning"])

    def is_running(self):
        return self.thread.is_alive()

    def cancel(self):
        self.cancelled = True
        self.process.terminate()

    def wait(self):
        self.thread.join()


def private_folder():
    """For the scene as it is now. Its name decides where ods keeps what it makes of it, so it is new each time."""
    return tempfile.mkdtemp(prefix="omnistereo-")


def find_program(wanted):
    """The command's path; empty: there is none."""
    return shutil.which(os.path.expanduser(wanted or "ods")) or ""
