# What programs of other projects find of talus, one part a call: install_test.sh SOURCE BUILD FOLDER PART. Part `install`
# comes first: it installs into FOLDER and moves the tree, which the other parts read.
set -euo pipefail
source=$1 build=$2 folder=$3 part=$4
here=$source/tests/install
tree=$folder/moved

fail() {
  echo "$*" >&2
  exit 1
}
# configure CONFIG_FOLDER PROGRAM COMPONENTS [OPTION...]: a project of one program with its libraries.
configure() {
  project=$(mktemp -d "$folder/project.XXXXXX")
  cmake -S "$here/program" -B "$project" -Dtalus_DIR="$1" -DPROGRAM="$2" -DCOMPONENTS="$3" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS="-I$source/docs/examples" "${@:4}" >"$project/log" 2>&1
}
make_program() {
  configure "$@" || fail "$(cat "$project/log")"
  cmake --build "$project" >"$project/log" 2>&1 || fail "$(tail -n 40 "$project/log")"
}
config_of_tree() { dirname "$(find "$tree" -name talusConfig.cmake)"; }
use_pkg_config_of_tree() { export PKG_CONFIG_PATH=$(dirname "$(find "$tree" -name talus.pc)"); }
expect() { # PATTERN COMMAND...
  local output
  output=$("${@:2}") || fail "$*: exit code $?"
  grep -qE "$1" <<<"$output" || fail "not /$1/: $output"
}
first_pile='^100 bodies, [0-9]+ awake$'

case $part in
install) # nothing in the tree points back to the source or the build, and the command finds its scenes
  rm -rf "$folder"
  cmake --install "$build" --prefix "$folder/installed" >/dev/null
  mv "$folder/installed" "$tree"
  cp -r "$tree/bin" "$folder/stripped"
  strip "$folder/stripped/talus"
  ! grep -rlE "$source|$folder/installed" "$tree"/{include,share} "$(config_of_tree)" "$(find "$tree" -name pkgconfig)" \
    "$folder/stripped" || fail "the files above name the folder of the source, the build or the first place"
  cd /
  expect drop_in_a_pile_2d "$tree/bin/talus" list
  ;;
build_tree) # a project that reads the build's folder
  make_program "$build/cmake" "$source/docs/examples/first_pile.cc" box2d
  expect "$first_pile" "$project/program"
  ;;
moved_tree)
  make_program "$(config_of_tree)" "$source/docs/examples/first_pile.cc" box2d
  expect "$first_pile" "$project/program"
  ;;
every_component) # a scene file, Bullet and a record, which the installed command reads
  make_program "$(config_of_tree)" "$here/recorded_pile.cc" "core;scene;box2d;bullet;telemetry"
  printf '%s\n' 'title = "Balls"' 'dimension = 3' 'run.frames = 30' \
    'shape.a = {kind = "ball", radius = 0.5}' '[[source]]' 'count = 9' >"$project/a.toml"
  expect '^talus [0-9.]+: [1-9] bodies$' "$project/program" "$project/a.toml" "$project/a.lcm"
  expect 'finished' "$tree/bin/talus" info "$project/a.lcm"
  ;;
core_alone) # neither what reads scene files nor an engine is needed
  make_program "$(config_of_tree)" "$here/toy_pile.cc" core \
    -DCMAKE_DISABLE_FIND_PACKAGE_{tomlplusplus,tinyobjloader,box2d,BulletPhysics,LCM,spdlog}=ON
  expect '^20 bodies, 0 awake$' "$project/program"
  ;;
pkg_config) # without CMake
  use_pkg_config_of_tree
  g++ -std=c++20 -O1 "$source/docs/examples/first_pile.cc" -o "$folder/first_pile" $(pkg-config --cflags --libs talus-box2d)
  expect "$first_pile" "$folder/first_pile"
  ;;
c_library) # C with CMake and without; the library has the functions of talus.h and no other symbol
  make_program "$(config_of_tree)" "$source/docs/examples/c_pile.c" c -DCMAKE_DISABLE_FIND_PACKAGE_{Eigen3,fmt}=ON
  expect '^20 balls, 20 asleep$' "$project/program"
  use_pkg_config_of_tree
  gcc -std=c11 -Wall -Wextra -Werror "$source/docs/examples/c_pile.c" -o "$folder/c_pile" $(pkg-config --cflags --libs talus)
  library=$(find "$tree" -name libtalus.so)
  expect '^20 balls, 20 asleep$' env LD_LIBRARY_PATH="$(dirname "$library")" "$folder/c_pile"
  others=$(nm -D --defined-only "$library" | awk '$3 !~ /^(talus_|TALUS_0)/')
  [[ -z $others ]] || fail "also exported: $others"
  ;;
headers) # each compiles alone and without a warning
  use_pkg_config_of_tree
  modules=$(cd "$PKG_CONFIG_PATH" && printf '%s\n' *.pc | sed 's/\.pc$//')
  for header in "$tree"/include/talus/*.h; do
    [[ $header == */box2d_v3.h ]] && continue # needs another Box2D than the others
    echo "#include <talus/$(basename "$header")>" |
      g++ -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -x c++ - $(pkg-config --cflags $modules) ||
      fail "${header##*/} does not compile alone"
  done
  ;;
other_alignment) # AVX moves the members of the library's structs: refused when compiled, but for Eigen at 16 bytes
  use_pkg_config_of_tree
  compile() { g++ -std=c++20 -fsyntax-only -mavx2 "$@" "$here/toy_pile.cc" -I "$source/docs/examples" $(pkg-config --cflags talus-core); }
  ! compile 2>"$folder/log" || fail "the headers compile with another layout"
  grep -q 'compile without AVX' "$folder/log" || fail "$(head "$folder/log")"
  compile -DEIGEN_MAX_ALIGN_BYTES=16
  ;;
missing_component)
  ! configure "$(config_of_tree)" "$here/toy_pile.cc" "core;mujoco" || fail "component mujoco was found"
  tr -s ' \n' ' ' <"$project/log" | grep -q 'component mujoco is not in this build of talus, which has: core;scene' ||
    fail "$(cat "$project/log")"
  ;;
*) fail "no such part: $part" ;;
esac
