# common/ includes neither an engine, nor LCM, nor a folder above it; a backend includes neither the other one nor LCM.
set -eu
box2d='box2d/|b2_'
bullet='bullet/|bt[A-Z]|Bullet[A-Z]|LinearMath/'
above='lcm/|lcmtypes/|tools/'
failed=0

check() { # FOLDER FORBIDDEN
  status=0
  git grep -nE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($2)" -- "$1/*.h" "$1/*.cc" || status=$?
  [ $status -eq 1 ] && return # nothing found
  echo "The lines above include what $1/ must not know (git grep: $status)."
  failed=1
}

check common "$box2d|$bullet|$above|sim2d/|sim3d/"
check sim2d "$bullet|$above|sim3d/"
check sim3d "$box2d|$above|sim2d/"
exit $failed
