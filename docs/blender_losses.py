#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the table of all lines of the ledger (blender/omnistereo/bridge) into docs/blender.md.

    docs/blender_losses.py            writes it
    docs/blender_losses.py --check    fails if the table there is another

A line is a call of lose(sentence, kind, name, remedy) or say(text). Text that is computed is "...", unless it is one of
a few words that the same function lists.
"""
import ast
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "blender.md"
BEGIN, END = "<!-- lines of the ledger: docs/blender_losses.py -->\n", "<!-- end of the lines -->\n"


def words_of(value, function):
    """The texts that an expression may be."""
    if isinstance(value, ast.Constant):
        return [value.value] if isinstance(value.value, str) else []
    if isinstance(value, ast.IfExp):
        return words_of(value.body, function) + words_of(value.orelse, function)
    if isinstance(value, ast.Dict):
        return [word for each in value.values for word in words_of(each, function)]
    if isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute) and value.func.attr == "get":
        return words_of(value.func.value, function)
    if isinstance(value, ast.Name):
        found = [node.value for node in ast.walk(function) if isinstance(node, ast.Assign)
                 and any(isinstance(target, ast.Name) and target.id == value.id for target in node.targets)]
        return [word for each in found for word in words_of(each, function)]
    return []


def texts_of(value, function):
    """The texts that the argument of a call may be."""
    if not isinstance(value, ast.JoinedStr):
        return list(dict.fromkeys(words_of(value, function))) or ["..."]
    texts = [""]
    for part in value.values:
        more = [part.value] if isinstance(part, ast.Constant) else (
            list(dict.fromkeys(words_of(part.value, function))) or ["..."])
        texts = [text + each for text in texts for each in more]
    return texts


def rows_of(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
        for node in ast.walk(function):
            name = node.func.attr if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) else ""
            if function.name == name or name not in ("lose", "say"):
                continue
            arguments = [texts_of(each, function) for each in node.args]
            ours = isinstance(node.func.value, ast.Name) and node.func.value.id == "self" and path.stem == "looks"
            kinds = ["material"] if ours else arguments[1] if name == "lose" else ["scene"]
            remedies = arguments[1 if ours else 3] if len(arguments) > (1 if ours else 3) else [""]
            for sentence in arguments[0]:
                for kind in kinds:
                    yield sentence, kind, " or: ".join(remedies)


def table():
    rows = {row for path in sorted((ROOT / "blender" / "omnistereo" / "bridge").glob("*.py")) for row in rows_of(path)}
    rows = {row for row in rows if row[2] or not any(row[:2] == each[:2] and each[2] for each in rows)}
    rows = sorted(rows, key=lambda row: (row[1] == "...", row[1], row[0].lower()))
    lines = [f"| {kind if kind != '...' else 'any'} | {sentence} | {remedy} |\n" for sentence, kind, remedy in rows]
    return "| of a | line | what to try |\n|---|---|---|\n" + "".join(lines)


def main(arguments):
    page = PAGE.read_text(encoding="utf-8")
    before, rest = page.split(BEGIN)
    after = rest.split(END)[1]
    made = before + BEGIN + table() + END + after
    if "--check" in arguments:
        return 0 if made == page else "docs/blender.md: the table of lines is not the ledger's: run docs/blender_losses.py"
    PAGE.write_text(made, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
