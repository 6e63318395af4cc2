# For tests of several processes: source it with $part and $@ of the script. The script runs in a network namespace of its
# own, whose only route is that for multicast on the loopback device; where the system allows no namespace, on the
# machine's network, at a port that nobody else uses. Working directory is a scratch folder.
if [[ -z ${LIVE_TEST_INSIDE:-} ]]; then
  export LIVE_TEST_INSIDE=plain
  for options in "--map-root-user --net" --net; do # root has the second in a chroot too
    # shellcheck disable=SC2086
    if unshare $options true 2>/dev/null; then LIVE_TEST_INSIDE=namespace exec unshare $options bash "$0" "$@"; fi
  done
fi
if [[ $LIVE_TEST_INSIDE == namespace ]]; then
  ip link set lo up
  [[ $part == no_route ]] || ip route add 224.0.0.0/4 dev lo
fi

folder=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
port=$((20000 + $$ % 20000))
url="udpm://239.255.76.67:$port?ttl=0"


fail() {
  echo "$(basename "$0") $part: $*" >&2
  tail -n 3 ./*.json ./*.txt >&2 || true
  exit 1
}
expect() { grep -q -- "$1" "$2" || fail "no $1 in $2"; } # PATTERN FILE
