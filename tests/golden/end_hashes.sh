#!/usr/bin/env bash
# Prints the end hash of every shipped scene under every policy on every backend, one line each: scene, backend,
# policy, hash. Compare the output of two builds with diff: a refactoring must change no line.
# Usage: end_hashes.sh TALUS [JOBS] [PATTERN]   (PATTERN: a regular expression for scene names; default all)
set -euo pipefail
talus=$(readlink -f "$1") jobs=${2-$(nproc)} pattern=${3-.}
cd "$(dirname "${BASH_SOURCE[0]}")/../../scenes"

# Scenes of hours are cut to this many frames; those that end at rest, whenever that is, to the paper's.
short_frames=600
options_of() {
  case $1 in
    million* | ten_thousand*) echo "--set run.frames=$short_frames" ;;
    drop_in_a_pile* | several_sizes*) echo "--set run.frames=1818 --set run.until=frames" ;;
    varying_drops*) echo "--set run.frames=856 --set run.until=frames" ;;
    multiple_piles*) echo "--set run.frames=2203 --set run.until=frames" ;;
    bunny_matrices*) echo "--set run.frames=312 --set run.until=frames" ;;
    drop_in_a_line*) echo "--set run.frames=928 --set run.until=frames" ;;
    rings_in_a_box*) echo "--set run.frames=1061 --set run.until=frames" ;;
  esac
}
line() { # SCENE BACKEND POLICY
  local hash
  # shellcheck disable=SC2046  # words of options
  hash=$("$talus" run "$PWD/$1.toml" --backend "$2" --policy "$3" $(options_of "$1") --hash 2>&1 | tail -n 1)
  echo "$1 $2 $3 $hash"
}
export -f line options_of
export talus short_frames

for scene in $(printf "%s\n" *.toml | sed "s/\.toml$//" | grep -E "$pattern"); do
  case $scene in *_2d) backends="box2d bullet-planar" ;; *) backends=bullet ;; esac
  for backend in $backends; do
    for policy in adaptive paper engine full; do echo "$scene $backend $policy"; done
  done
done | xargs -P "$jobs" -L 1 bash -c 'line "$0" "$1" "$2"' | sort
