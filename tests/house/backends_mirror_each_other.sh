# sim2d/ and sim3d/ hold headers of the same names, which hold the same thing for the two engines. sim3d/bullet/ holds
# replacements of Bullet's own classes and is left out. Each exemption below has its reason.
set -eu
exempt='
tag.h               Box2D has no body of its own for a frozen one, so each fixture names its owner and piece
static_hosts.h      Box2D visits all bodies in a step, so frozen ones share static bodies
contact_records.h   Box2D tells impulses and speeds to a listener only, Bullet keeps them in its contact points
continuous.h        Box2D is told for each pair whether to sweep, Bullet sweeps each body above a speed
collision.h         what walks over the contacts of Box2D; the same for Bullet is in sim3d/bullet/
body_swap.h         Bullet keeps a body in its broadphase entry while it changes its form
bodies.h            Bullet leaves the memory of its bodies to the caller
engine.h            Bullet is a set of objects, Box2D one b2World
plain_heap.h        Box2D has no allocator that a program can replace
friction_impulse.h  Bullet keeps friction in two directions of its own choice'

headers() {
  git ls-files "$1/*.h" | sed "s|^$1/||" | grep -v '^bullet/' | grep -vxF "$(echo "$exempt" | cut -d ' ' -f 1)" |
    LC_ALL=C sort | tr '\n' ' '
}
in_2d=$(headers sim2d)
in_3d=$(headers sim3d)
if [ "$in_2d" != "$in_3d" ] || [ -z "$in_2d" ]; then
  echo "sim2d/ has: $in_2d"
  echo "sim3d/ has: $in_3d"
  exit 1
fi
for name in $(echo "$exempt" | cut -d ' ' -f 1); do
  [ "$(git ls-files "sim2d/$name" "sim3d/$name" | wc -l)" = 1 ] && continue
  echo "$name is exempt, but not in one folder only"
  exit 1
done
