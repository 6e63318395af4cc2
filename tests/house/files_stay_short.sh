# No file of code is longer than 250 lines: past that it holds more than one concept.
set -eu
git ls-files '*.h' '*.cc' '*.cmake' '*CMakeLists.txt' '*.sh' '*.lcm' dev .ci/run | xargs wc -l | awk '
  $2 != "total" && $1 > 250 { print $2 " has " $1 " lines; split it"; failed = 1 }
  END { exit failed }'
