# The screen of the monitor in a terminal, as tmux shows it, one part a call: screen_test.sh PROGRAM PART.
set -euo pipefail
program=$1 part=$2
source "$(dirname "$0")/network.sh"
export TMUX_TMPDIR=$folder LC_ALL=C.UTF-8
unset TMUX NO_COLOR
trap 'tmux kill-server 2>/dev/null || true; kill $(jobs -p) 2>/dev/null || true; rm -rf "$folder"' EXIT

# Opens a terminal of 80 x 24 with a command in it; its exit code is printed when it ends.
terminal() { tmux -f /dev/null new-session -d -x 80 -y 24 "$*; echo exit code \$?; sleep 60"; }
screen() { tmux capture-pane -p "$@" >screen.txt; }
# Waits until the screen shows a pattern, at most for so many seconds.
shown() { # SECONDS PATTERN
  local end=$((SECONDS + $1 + 1))
  until screen && grep -q -- "$2" screen.txt; do
    ((SECONDS < end)) || { cat screen.txt >&2; fail "the screen does not show $2"; }
    sleep 0.1
  done
}
press() { tmux send-keys "$@"; }
widest() { wc -L <screen.txt; }
run() { "$program" run --record run.lcm --lcm-url "$url" --paced "$@" >hash.txt; }

case $part in
pages) # from waiting to the end of a run; each page by its key; larger and smaller terminals
  terminal "$program" monitor --lcm-url "'$url'" --fail-on-loss
  shown 15 "waiting on udpm://239.255.76.67:$port"
  run --frames 180 &
  shown 15 'small_pile box2d adaptive'
  shown 15 'step [1-9][0-9]* of [0-9]*  .* x real time'
  shown 15 'pile 0: [0-9]* layers'
  shown 15 'lost 0$'
  shown 15 '[0-9] woke  [a-z]'
  expect ' SLEEP *[1-9]' screen.txt
  expect 'ms per step: [0-9]' screen.txt
  [[ $(wc -l <screen.txt) == 24 && $(widest) -le 80 ]] || fail "the screen is not 80 x 24"
  press e && shown 15 'cause *slept *woke'
  press f && shown 15 'events: woke'
  press l && shown 15 'layer dens'
  press r && shown 15 'awake asleep x real'
  press '?' && shown 15 'q, Ctrl-C   quit'
  press Escape && shown 15 'ms per step'
  tmux resize-window -x 132 -y 43
  shown 15 'ms per step'
  sleep 0.3 && screen
  (($(widest) > 80 && $(awk '/ q quit|^q quit/ { print NR }' screen.txt) == 43)) || fail "the screen is not larger"
  tmux resize-window -x 80 -y 24
  sleep 0.5 && screen
  (($(widest) <= 80)) && expect '^q quit' screen.txt && expect 'ms per step' screen.txt
  tmux resize-window -x 30 -y 5
  shown 15 'needs 40 x 8'
  tmux resize-window -x 80 -y 24
  shown 15 'ended: finished'
  press q
  shown 15 'exit code 0'
  expect 'small_pile box2d adaptive' screen.txt # what was last known stays in the terminal
  ;;

without_colours) # a terminal of 1978, NO_COLOR, and a locale without UTF-8: neither colours nor blocks
  terminal env LC_ALL=C TERM=vt100 "$program" monitor --lcm-url "'$url'"
  run --frames 120 &
  shown 15 'pile 0: [0-9]* layers'
  shown 15 '##'
  screen -e
  ! grep -q $'\e\[3[0-7]' screen.txt || fail "there are colours"
  ! LC_ALL=C grep -q $'[\x80-\xff]' screen.txt || fail "there are characters beyond ASCII"
  press q && shown 15 'exit code 0'
  tmux kill-server
  TMUX_TMPDIR=$(mktemp -d -p "$folder") # the old server may not be gone yet
  terminal env TERM=screen-256color NO_COLOR=1 "$program" monitor --lcm-url "'$url'"
  run --frames 120 &
  shown 15 'pile 0: [0-9]* layers'
  screen -e
  ! grep -q $'\e\[3[0-7]' screen.txt || fail "NO_COLOR is not obeyed"
  press q && shown 15 'exit code 0'
  ;;

late) # all is there within two seconds of a start in the middle of a run
  run --frames 120 &
  sleep 1.5
  terminal "$program" monitor --lcm-url "'$url'"
  shown 2 'small_pile box2d adaptive'
  shown 1 'pile 0: [0-9]* layers'
  expect 'awake [0-9]' screen.txt
  expect 'lost 0$' screen.txt
  press q && shown 2 'exit code 0'
  ;;

two_runs) # two runs at once: by key, and in a table
  terminal "$program" monitor --lcm-url "'$url'"
  run --frames 200 &
  "$program" run --record other.lcm --lcm-url "$url" --paced --frames 200 >other.txt &
  shown 15 'run 1 of 2'
  press Tab && shown 15 'run 2 of 2'
  press r
  shown 15 '^   1 .* adaptive  *box2d small_pile'
  shown 15 '^   2 .* box2d small_pile'
  press q && shown 15 'exit code 0'
  ;;

relay) # a network that loses, doubles and reorders: the loss is counted exactly, and nothing hangs
  there=$((port + 1))
  "$program" relay "$port" "$there" >relay.txt &
  relay=$!
  terminal "$program" monitor --lcm-url "'udpm://239.255.76.67:$there?ttl=0'" --fail-on-loss
  "$program" monitor --lcm-url "udpm://239.255.76.67:$there?ttl=0" --json >seen.json &
  monitor=$!
  sleep 1
  run --frames 200
  shown 15 'ended: finished'
  kill -TERM $relay && wait $relay
  dropped=$(sed -n 's/^dropped //p' relay.txt)
  ((dropped >= 5)) || fail "the relay dropped only $dropped"
  expect '^doubled [1-9]' relay.txt
  expect '^late [1-9]' relay.txt
  shown 15 " lost $dropped$"
  press a && shown 15 "$dropped of [0-9]* messages lost"
  press q && shown 15 'exit code 1'
  kill -INT $monitor && wait $monitor
  lost=$(grep '"run"' seen.json | tail -n 1 | sed 's/.*"lost":{\([^}]*\)}.*/\1/' | tr ',' '\n' | awk -F: '{ sum += $2 } END { print sum }')
  [[ $lost == "$dropped" ]] || fail "the relay dropped $dropped, the monitor counts $lost"
  "$program" run --record silent.lcm --silent --frames 200 >silent.txt
  cmp hash.txt silent.txt # and the run does not depend on it
  ;;

*)
  fail "no such part"
  ;;
esac
