# The include graph of the folders in common/, and that of the folders in tools/, has no cycle: each folder can be
# understood from those below it.
set -eu
for room in common tools; do
  edges=$(git grep -HoE "^#include \"$room/[^\"]+/" -- "$room/*.h" "$room/*.cc" | awk -F: '{
    sub(/\/[^\/]*$/, "", $1); sub(/.*"/, "", $2); sub(/\/$/, "", $2); if ($1 != $2) print $1, $2 }' | LC_ALL=C sort -u)
  [ -n "$edges" ] || { echo "no include found in $room/"; exit 1; }
  errors=$(echo "$edges" | tsort 2>&1 >/dev/null) && continue
  echo "Folders of $room/ that include each other in a cycle:"
  echo "$errors" | sed -n "s/^tsort: \($room.*\)/  \1/p"
  exit 1
done
