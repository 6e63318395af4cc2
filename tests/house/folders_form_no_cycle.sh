# The include graph of the folders in common/ has no cycle: each folder can be understood from those below it.
set -eu
edges=$(git grep -HoE '^#include "common/[^"]+/' -- 'common/*.h' 'common/*.cc' | awk -F: '{
  sub(/\/[^\/]*$/, "", $1); sub(/.*"/, "", $2); sub(/\/$/, "", $2); if ($1 != $2) print $1, $2 }' | LC_ALL=C sort -u)
[ -n "$edges" ] || { echo "no include found in common/"; exit 1; }
errors=$(echo "$edges" | tsort 2>&1 >/dev/null) && exit 0
echo "Folders of common/ that include each other in a cycle:"
echo "$errors" | sed -n 's/^tsort: \(common.*\)/  \1/p'
exit 1
