# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What the bridge says to the program that started it: lines on stderr that begin with a word of ours."""
import sys


class Failure(Exception):
    """An error of one line."""


def say(word, text):
    text = " ".join(str(text).split())
    sys.stderr.write(f"ods-bridge {word} {text}\n")
    sys.stderr.flush()


def step(what, share):
    """share: of the whole work that is done then, 0 to 1."""
    say("step", f"{share:.3f} {what}")
