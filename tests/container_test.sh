#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# container_test.sh SOURCE: builds the container and runs its command.
set -eu
cd "$1"
image=localhost/ods-test

skip() {
  echo "skipped: $*"
  exit 0
}

tool=$(command -v podman || command -v buildah) || skip "there is neither podman nor buildah"
for base in $(sed -n 's/^FROM \([^ ]*\).*/\1/p' Containerfile); do
  "$tool" inspect --type image "$base" >/dev/null 2>&1 || timeout 60 "$tool" pull --quiet "$base" >/dev/null 2>&1 ||
    skip "$tool cannot get $base"
done
"$tool" build --tag "$image" --file Containerfile .
case $tool in
  *podman) "$tool" run --rm "$image" render furnace --width 16 --samples 1 -o /tmp/picture.png ;;
  *)
    container=$("$tool" from "$image")
    "$tool" run "$container" -- ods render furnace --width 16 --samples 1 -o /tmp/picture.png
    "$tool" rm "$container" ;;
esac
