#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# slurm_test.sh ODS: a cluster of two nodes on this machine, of our own munge and Slurm, for as long as this script runs.
# A video and a picture in parts go through it while one node dies; what comes out has the bits of a single process.
# Prints "skipped: why" where Slurm is not installed. Needs nothing but the packages slurm-wlm and munge, and no root.
#
# slurm_test.sh ODS quick: only that, with small frames and few of them.
# slurm_test.sh ODS ratio: how long the cluster takes for a video, over one process of two threads.
set -eu
ods=$(realpath "$1")
for program in munged slurmctld slurmd sbatch squeue scontrol; do
  PATH=$PATH:/usr/sbin command -v $program >/dev/null || { echo "skipped: $program is not installed (slurm-wlm, munge)"; exit 0; }
done
PATH=$PATH:/usr/sbin
here=$(mktemp -d /tmp/ods-farm-XXXXXX)
export SLURM_CONF=$here/slurm.conf

say() { printf 'farm, %s: %s\n' "$(date +%T)" "$*"; }
die() {
  say "FAILED: $*"
  tail -n 20 "$here"/*.log 2>/dev/null || :
  exit 1
}

# --- the cluster ----------------------------------------------------------------------------------------------------

# The processes of a node: of its jobs, their shepherds, and its daemon.
processes_of() {
  for folder in /proc/[0-9]*; do
    grep -qzxs "SLURMD_NODENAME=$1" "$folder/environ" && grep -qzxs "SLURM_CONF=$SLURM_CONF" "$folder/environ" || continue
    sed -n 's/^PPid:\t//p' "$folder/status" 2>/dev/null || :
    echo "${folder#/proc/}"
  done | sort -u | grep -vx -e 0 -e 1 -e $$ || :
  cat "$here/slurmd-$1.pid" 2>/dev/null || :
}

kill_all() {
  for process in "$@"; do kill -9 "$process" 2>/dev/null || :; done
}

clean_up() {
  code=$?
  trap - EXIT INT TERM
  for daemon in one two; do kill_all $(processes_of $daemon); done
  for file in "$here"/*.pid; do [ ! -f "$file" ] || kill_all "$(cat "$file")"; done
  sleep 1
  rm -rf "$here" || { sleep 2; rm -rf "$here"; }
  exit $code
}
trap clean_up EXIT
trap 'exit 1' INT TERM

# Ports that are free by the kernel's lists.
ports=$(awk 'FNR > 1 { split($2, a, ":"); print a[2] }' /proc/net/tcp | while read -r hex; do echo $((0x$hex)); done)
port=21000
next_port() {
  while echo "$ports" | grep -qx $port; do port=$((port + 1)); done
  port=$((port + 1))
  echo $((port - 1))
}

start_cluster() {
  me=$(id -un) host=$(hostname -s)
  port_of_controller=$(next_port); port=$((port_of_controller + 1))
  port_of_one=$(next_port); port=$((port_of_one + 1))
  port_of_two=$(next_port)
  mkdir "$here/state" "$here/spool-one" "$here/spool-two"
  dd if=/dev/urandom of="$here/munge.key" bs=128 count=1 2>/dev/null
  chmod 400 "$here/munge.key"
  munged --force --key-file="$here/munge.key" --socket="$here/munge.socket" --pid-file="$here/munged.pid" \
    --log-file="$here/munged.log" --seed-file="$here/munge.seed" --num-threads=2 >"$here/start.log" 2>&1 || die "munged"
  cat >"$SLURM_CONF" <<END
ClusterName=ods
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$me
SlurmdUser=$me
AuthType=auth/munge
AuthInfo=socket=$here/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation=$here/state
SlurmctldPort=$port_of_controller
SlurmctldPidFile=$here/slurmctld.pid
SlurmctldLogFile=$here/slurmctld.log
SlurmdPidFile=$here/slurmd-%n.pid
SlurmdSpoolDir=$here/spool-%n
SlurmdLogFile=$here/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MaxArraySize=9
KillWait=5
ReturnToService=0
SchedulerParameters=batch_sched_delay=0,sched_interval=2,bf_interval=2
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$port_of_one CPUs=1 RealMemory=8000
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=$port_of_two CPUs=1 RealMemory=8000
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
END
  slurmctld >>"$here/start.log" 2>&1 || die "slurmctld"
  slurmd -N one >>"$here/start.log" 2>&1 || die "slurmd one"
  slurmd -N two >>"$here/start.log" 2>&1 || die "slurmd two"
  for try in $(seq 60); do
    [ "$(sinfo --noheader --states=idle --format=%D 2>/dev/null)" = 2 ] && return
    sleep 1
  done
  die "the nodes do not come up: $(sinfo 2>&1)"
}

# wait_for SECONDS "what" COMMAND...: until it succeeds.
wait_for() {
  limit=$1 what=$2
  shift 2
  for try in $(seq $((2 * limit))); do
    "$@" && return
    sleep 0.5
  done
  squeue || :
  die "waited $limit s for $what"
}

# --- what goes through ----------------------------------------------------------------------------------------------

number=40 chunk=4 width=96 samples=64 parts=16
# A task is long enough to be killed in its middle.
[ "${2:-}" != quick ] || number=10 chunk=1 width=64 samples=256 parts=4
frames="video toys --frames 1-$number --width $width --samples $samples --keep-frames --threads 1"
still="render room --width $width --samples $((16 * parts)) --threads 1"

at_work_on() { squeue --noheader --states=running --nodelist="$1" --format=%i | grep -q .; }
has_frames() { [ "$(find "$here/farm" -name 'frame.*.exr' ! -name '.*' | wc -l)" -ge "$1" ]; }

# Until a task dies with it: one that was seen a moment ago may have ended by itself.
kill_node_two() {
  for try in 1 2 3 4 5; do
    wait_for 300 "work on the node two" at_work_on two
    kill_all $(cat "$here/slurmd-two.pid") $(processes_of two)
    sleep 1
    at_work_on two && return
    slurmd -N two
  done
  die "no task was killed"
}

test_a_node_dies() {
  "$ods" $frames -q -o "$here/one/film_360_TB.mp4"
  "$ods" $still -q --noise none --denoise none -o "$here/one/still.exr"
  "$ods" submit --to slurm --chunk $chunk -- $frames -o "$here/farm/film_360_TB.mp4" >"$here/sent" || die "submit"
  "$ods" submit --to slurm -- $still --denoise none -o "$here/farm/still.exr" --parts $parts >>"$here/sent" || die "submit"
  [ "$(grep -c frames "$here/sent")" = 2 ] || die "ten tasks are two arrays of at most eight: $(cat "$here/sent")"
  wait_for 120 "frames" has_frames 3
  kill_node_two
  say "killed the node two at work on: $(squeue --noheader --states=running --nodelist=two --format='%j %K')"
  scontrol update NodeName=two State=DOWN Reason=killed
  "$ods" jobs
  timeout 900 "$ods" jobs film_360_TB --follow >"$here/followed" || die "the video: $(cat "$here/followed")"
  timeout 900 "$ods" jobs still --follow >>"$here/followed" || die "the picture: $(cat "$here/followed")"
  grep -c . "$here"/farm/*.farm/starts/* | grep -v ':1$' || die "nothing was requeued"
  for file in "$here"/one/film_360_TB.mp4.frames/frame.*.exr; do
    cmp "$file" "$here/farm/film_360_TB.mp4.frames/$(basename "$file")" || die "a frame differs"
  done
  cmp "$here/one/film_360_TB.mp4" "$here/farm/film_360_TB.mp4" || die "the video differs"
  cmp "$here/one/still.exr" "$here/farm/still.exr" || die "the picture differs"
  say "a video of $number frames and a picture of $parts parts have the bits of one process, although a node died"
}

test_a_task_fails() {
  cp "$here/scene.gltf" "$here/gone.gltf"
  "$ods" submit -q --to slurm --chunk 2 -- video "$here/gone.gltf" -o "$here/farm/gone_360_TB.mp4" --frames 1-2 --width 32
  rm "$here/gone.gltf"
  if timeout 300 "$ods" jobs gone_360_TB --follow >"$here/followed" 2>&1; then die "a failed task is not said"; fi
  grep "gone_360_TB frames 1: on one, exit code 3: ods: error: .*gone.gltf" "$here/followed" || die "$(cat "$here/followed")"
  [ "$(grep -c "^frames 1 of 1, try" "$here/farm/gone_360_TB.farm/logs/frames.1.log")" = 3 ] || die "it was not tried thrice"
  say "a task that fails three times is shown with its last line"
}

# A limit of a minute is announced at once.
test_a_frame_is_too_long() {
  slurmd -N two
  wait_for 60 "the node two" scontrol update NodeName=two State=RESUME
  wait_for 60 "two nodes" sh -c '[ "$(sinfo --noheader --states=idle --format=%D)" = 2 ]'
  "$ods" submit -q --to slurm --chunk 2 --sbatch --time=1 -- video room --frames 1-2 --width 2048 --samples 64 --threads 1 \
    -o "$here/farm/long_360_TB.mp4"
  if timeout 400 "$ods" jobs long_360_TB --follow >"$here/followed" 2>&1; then die "a frame that never ends is not said"; fi
  grep "long_360_TB frames 1: on one, two, exit code 143: ods: error: the time limit was over three times" "$here/followed" ||
    die "$(cat "$here/followed")"
  [ "$(sort -u "$here/farm/long_360_TB.farm/starts/frames.1" | wc -l)" = 2 ] || die "it was not tried on another node"
  say "a frame that is longer than the time limit ends after three starts, on both nodes"
}

test_cancel_and_go_on() {
  "$ods" submit -q --to slurm --chunk 4 -- $frames -o "$here/farm/again_360_TB.mp4"
  wait_for 120 "frames" sh -c "ls '$here'/farm/again_360_TB.mp4.frames/frame.00000[2-9].exr >/dev/null 2>&1"
  scancel --user="$(id -un)"
  wait_for 60 "the end of the jobs" sh -c '[ -z "$(squeue --noheader --states=running,completing,pending)" ]'
  for file in "$here"/farm/again_360_TB.mp4.frames/frame.*.exr; do
    cmp "$file" "$here/one/film_360_TB.mp4.frames/$(basename "$file")" || die "a frame is not whole"
  done
  "$ods" submit -q --to slurm --chunk 4 -- $frames -o "$here/farm/again_360_TB.mp4"
  timeout 900 "$ods" jobs again_360_TB --follow >"$here/followed" || die "$(cat "$here/followed")"
  cmp "$here/one/film_360_TB.mp4" "$here/farm/again_360_TB.mp4" || die "the video differs"
  say "a cancelled job leaves whole frames, and submitted again it goes on"
}

# --- how long it takes ------------------------------------------------------------------------------------------------

now() { date +%s.%N; }
is_over() { [ -z "$(squeue --noheader --format=%i)" ]; }

# From submit's start to the end of the last job, in two tasks that have a node each.
measure_ratio() {
  video="video toys --frames 1-40 --width 512 --samples 4"
  load=$(cut -d ' ' -f 1-3 /proc/loadavg)
  start=$(now)
  "$ods" $video -q --threads 2 -o "$here/one/film_360_TB.mp4"
  middle=$(now)
  "$ods" submit -q --to slurm --chunk 20 -- $video --threads 1 -o "$here/farm/film_360_TB.mp4"
  wait_for 3600 "the video" is_over
  end=$(now)
  cmp "$here/one/film_360_TB.mp4" "$here/farm/film_360_TB.mp4" || die "the video differs"
  echo "$start $middle $end" | awk -v load="$load" '{
    printf "one process: %.1f s; two nodes: %.1f s; ratio %.2f; load before: %s\n", $2 - $1, $3 - $2, ($3 - $2) / ($2 - $1), load }'
}

mkdir "$here/one" "$here/farm"
cat >"$here/scene.gltf" <<'END'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
END
start_cluster
say "two nodes are up: $(sinfo --version), $(squeue --json >/dev/null 2>&1 && echo with --json || echo without --json)"
if [ "${2:-}" = ratio ]; then
  measure_ratio
  exit
fi
test_a_node_dies
if [ "${2:-}" = quick ]; then exit; fi
test_a_task_fails
test_a_frame_is_too_long
test_cancel_and_go_on
say "passed"
