# End hashes of short runs against the recorded ones in end_hashes.txt: sh compare_end_hashes.sh TALUS BACKEND [THREADS]
# prints each line that differs. `sh compare_end_hashes.sh TALUS all` prints the whole table as TALUS computes it, which replaces
# the file when a change of the results is intended.
set -eu
talus=$1
backend=$2
threads=${3:-1}
recorded=$(dirname "$0")/end_hashes.txt

# The lines of standard input with the end hashes that TALUS computes.
computed() {
  while read -r scene frames engine policy _; do
    hash=$("$talus" run "scenes/$scene.toml" --backend "$engine" --policy "$policy" --set "run.frames=$frames" \
      --threads "$threads" --hash)
    echo "$scene $frames $engine $policy $hash"
  done
}
lines() { grep -v '^#' "$recorded" | grep " $1 "; }

if [ "$backend" = all ]; then
  grep '^#' "$recorded"
  grep -v '^#' "$recorded" | computed
  exit
fi
lines "$backend" | computed >"${TMPDIR:-/tmp}/end_hashes.$$"
trap 'rm -f "${TMPDIR:-/tmp}/end_hashes.$$"' EXIT
lines "$backend" | diff - "${TMPDIR:-/tmp}/end_hashes.$$" && exit
echo "Lines with <: recorded in tests/golden/end_hashes.txt. Lines with >: computed by this build."
exit 1
