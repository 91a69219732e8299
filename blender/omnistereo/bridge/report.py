# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What the bridge says to whoever started it: lines on stderr that begin with a word of ours."""
import sys


class Failure(Exception):
    """An error of one line."""


class Report:
    def __init__(self):
        self.warnings = []

    def warn(self, text):
        if text not in self.warnings:
            self.warnings.append(text)

    def step(self, what, share):
        """share: of the whole work that is done then, 0 to 1."""
        say("step", f"{share:.3f} {what}")


def say(word, text):
    text = " ".join(str(text).split())
    sys.stderr.write(f"ods-bridge {word} {text}\n")
    sys.stderr.flush()


def some(names, most=4):
    """ 'a', 'b' and 3 more """
    names = [f"'{name}'" for name in names]
    if len(names) <= most:
        return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]
    return ", ".join(names[:most]) + f" and {len(names) - most} more"
