#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# manual.sh ODS FOLDER "CONTACT": the files installed beside the command: man pages and completions, which it prints
# itself, and the changelog that Debian requires.
set -eu
ods=$1
out=$2
rm -rf "$out"
mkdir -p "$out/man1"
"$ods" --help=man >"$out/man1/ods.1"
for command in $(sed -n 's/^\.BR ods\\-\([a-z]*\) .*/\1/p' "$out/man1/ods.1"); do
  "$ods" "$command" --help=man >"$out/man1/ods-$command.1"
done
version=$("$ods" --version | sed -n '1s/ods //p')
printf 'ods (%s-1) unstable; urgency=medium\n\n  * Version %s.\n\n -- %s  %s\n' "$version" "$version" "$3" "$(date -uR)" \
  >"$out/changelog.Debian"
gzip -9n "$out"/man1/*.1 "$out/changelog.Debian"
"$ods" --help=zsh >"$out/_ods"
"$ods" --help=bash >"$out/ods"
