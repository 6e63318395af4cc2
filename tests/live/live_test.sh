# Live telemetry between processes, one part a call: live_test.sh PROGRAM PART.
set -euo pipefail
program=$1 part=$2
source "$(dirname "$0")/network.sh"
# The number of events that a log has on a channel.
events() { "$program" count "$1" | sed -n "s/^$2 //p"; }
# Starts a monitor and waits until it has joined the group: until then it hears nothing.
monitor() { # OUTPUT OPTION...
  "$program" monitor --lcm-url "$url" --json "${@:2}" >"$1" &
  monitor=$!
  sleep 1
}

case $part in
live) # a run, watched by a monitor and recorded by lcm-logger: nothing is lost, both hear the same
  lcm-logger --quiet --lcm-url="$url" heard.lcm &
  logger=$!
  monitor seen.json --fail-on-loss
  "$program" run --record run.lcm --lcm-url "$url" --paced >hash.txt
  sleep 1.2
  kill -INT $monitor $logger
  wait $monitor || fail "the monitor's exit code is $?"
  wait $logger || true
  expect '"phase":"alive"' seen.json
  tail -n 1 seen.json >last.json
  expect '"phase":"end","reason":"finished"' last.json
  expect '"step":180' last.json
  expect '"slept":[1-9]' last.json
  expect '"lost":{"TALUS_RUN":0,"TALUS_PILES":0,"TALUS_SLEEP":0,"TALUS_STATS":0,"TALUS_BODIES":0,"TALUS_SHAPES":0,"TALUS_EVENTS":0,"TALUS_OBSTACLES":0,"TALUS_SCENE":0,"TALUS_INSTRUMENTS":0,"TALUS_CONTACTS":0},"undecodable":0' last.json
  [[ $(events heard.lcm TALUS_PILES) == 181 ]] || fail "lcm-logger: $("$program" count heard.lcm)"
  [[ $(events heard.lcm damaged) == 0 ]] || fail "lcm-logger: $("$program" count heard.lcm)"
  ;;

playback) # lcm-logplayer plays the record at the run's own pace, and the monitor shows it like a run
  "$program" run --record run.lcm --silent >hash.txt
  monitor seen.json --fail-on-loss
  begin=$(date +%s%N)
  lcm-logplayer --lcm-url="$url" run.lcm >player.txt
  milliseconds=$((($(date +%s%N) - begin) / 1000000))
  ((milliseconds >= 2900 && milliseconds <= 4000)) || fail "3 s of simulated time took $milliseconds ms"
  sleep 1.2
  kill -INT $monitor
  wait $monitor || fail "the monitor's exit code is $?"
  tail -n 1 seen.json >last.json
  expect '"phase":"end","reason":"finished"' last.json
  expect '"scene":"small_pile"' last.json
  expect '"slept":[1-9]' last.json
  expect '"step":180' last.json
  ;;

no_route) # one line says what to do, and the run is the same as without telemetry
  if [[ $LIVE_TEST_INSIDE == plain ]]; then url=udpm://255.255.255.255:7667; fi # no way to send there either
  "$program" run --record run.lcm --lcm-url "$url" >hash.txt 2>&1
  "$program" run --record silent.lcm --silent >silent.txt
  expect 'no live view' hash.txt
  [[ $(wc -l <hash.txt) == 2 ]] || fail "more than one line of complaint"
  [[ $(tail -n 1 hash.txt) == "$(cat silent.txt)" ]] || fail "another result"
  cmp run.lcm silent.lcm
  ! "$program" monitor --lcm-url "$url" --seconds 1 2>monitor.txt || fail "the monitor found a network"
  [[ $(wc -l <monitor.txt) == 1 ]] || fail "more than one line of complaint"
  ;;

stopped_listener) # a subscriber that stands still changes neither the run nor its record
  monitor seen.json
  kill -STOP $monitor
  "$program" run --record run.lcm --lcm-url "$url" --frames 300 >hash.txt
  kill -CONT $monitor
  "$program" run --record silent.lcm --frames 300 --silent >silent.txt
  cmp hash.txt silent.txt
  cmp run.lcm silent.lcm
  ;;

receiver_crash) # forged fragments crash LCM in the monitor's receiving process: it starts again within a second
  monitor seen.json --fail-on-loss
  "$program" run --record run.lcm --lcm-url "$url" --paced --frames 150 >hash.txt &
  run=$!
  sleep 2
  "$program" forge "$port" 40
  wait $run
  sleep 1.2
  kill -INT $monitor
  code=0
  wait $monitor || code=$?
  [[ $code == 1 ]] || fail "the monitor's exit code is $code: a crash is a fault"
  expect '"faults":{.*"receiver_crashes":[1-9].*"last_crash":"signal' seen.json
  grep '"run"' seen.json | tail -n 1 >last.json
  expect '"phase":"end","reason":"finished"' last.json
  [[ $(grep -c '"step":' seen.json) -ge 4 ]] || fail "the run was not shown each second"
  "$program" run --record silent.lcm --silent --frames 150 >silent.txt
  cmp hash.txt silent.txt
  ;;

invented_runs) # invented runs fill the monitor's table before the run begins: it is shown all the same
  monitor seen.json --fail-on-loss
  "$program" invent --lcm-url "$url" 64
  sleep 2.2
  "$program" run --record run.lcm --lcm-url "$url" --paced --frames 60 >hash.txt
  sleep 1.2
  kill -INT $monitor
  code=0
  wait $monitor || code=$?
  [[ $code == 1 ]] || fail "the monitor's exit code is $code: a dropped run is a fault"
  expect '"scene":"small_pile"' seen.json
  expect '"phase":"end","reason":"finished"' seen.json
  expect '"faults":{.*"dropped_runs":[1-9]' seen.json
  ;;

killed) # kill -9: the record is whole up to the last flush
  "$program" run --record run.lcm --lcm-url "$url" --paced --frames 3000 >hash.txt &
  sleep 2
  kill -KILL $!
  wait $! 2>/dev/null || true
  (($(events run.lcm TALUS_BODIES) >= 30)) || fail "$("$program" count run.lcm)"
  (($(events run.lcm damaged) < 60100)) || fail "more than one message is damaged: $("$program" count run.lcm)"
  ;;

*)
  fail "no such part"
  ;;
esac
