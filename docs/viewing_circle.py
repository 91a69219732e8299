#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/images/viewing-circle.svg: the rays of an ODS picture's columns, from above."""
import math
import os

WIDTH, HEIGHT, RADIUS, LENGTH = 760, 310, 58, 90
EYES = (("left", 190, -1, "#1f6fb2"), ("right", 570, 1, "#c0392b"))
lines = []


def draw_eye(name, middle, side, color):
    top = 140
    lines.append(f'<circle cx="{middle}" cy="{top}" r="{RADIUS}" fill="none" stroke="#999" stroke-width="1.5"/>')
    for column in range(16):
        turn = 2 * math.pi * column / 16  # where the head looks; 0 is ahead, up in the drawing
        ahead = math.sin(turn), -math.cos(turn)
        right = math.cos(turn), math.sin(turn)
        eye = middle + side * RADIUS * right[0], top + side * RADIUS * right[1]
        end = eye[0] + LENGTH * ahead[0], eye[1] + LENGTH * ahead[1]
        width = 3.5 if column == 0 else 1.5
        lines.append(f'<path d="M{eye[0]:.1f},{eye[1]:.1f}L{end[0]:.1f},{end[1]:.1f}" stroke="{color}"'
                     f' stroke-width="{width}" marker-end="url(#{name})"/>')
        lines.append(f'<circle cx="{eye[0]:.1f}" cy="{eye[1]:.1f}" r="{width + 1:.1f}" fill="{color}"/>')
    lines.append(f'<text x="{middle}" y="{HEIGHT - 12}" fill="{color}">{name} eye</text>')


for eye in EYES:
    draw_eye(*eye)
heads = "".join(f'<marker id="{name}" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="9" markerHeight="9"'
                f' markerUnits="userSpaceOnUse" orient="auto"><path d="M0,1L8,4L0,7z" fill="{color}"/></marker>'
                for name, _, _, color in EYES)
path = os.path.join(os.path.dirname(__file__), "images", "viewing-circle.svg")
with open(path, "w", encoding="utf-8") as file:
    file.write(f'''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"
  font-family="sans-serif" font-size="16" text-anchor="middle">
<title>The viewing circle from above: every column of a picture looks along its own tangent</title>
<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>
<defs>{heads}</defs>
<text x="{WIDTH / 2:.0f}" y="132" fill="#555">from above;</text>
<text x="{WIDTH / 2:.0f}" y="156" fill="#555">ahead is up</text>
''' + "\n".join(lines) + "\n</svg>\n")
