# sim2d/ and sim3d/ hold headers of the same names, so that who knows one backend finds the way in the other.
set -eu
only_one='(none)' # names that only one of them can have, as an extended regular expression, with the reason

headers() { git ls-files "$1/*.h" | sed "s|^$1/||" | grep -vxE "$only_one" | LC_ALL=C sort | tr '\n' ' '; }
in_2d=$(headers sim2d)
in_3d=$(headers sim3d)
[ "$in_2d" = "$in_3d" ] && [ -n "$in_2d" ] && exit 0
echo "sim2d/ has: $in_2d"
echo "sim3d/ has: $in_3d"
exit 1
