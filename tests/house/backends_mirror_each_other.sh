# sim2d/ and sim3d/ hold headers of the same names: the way through one backend is the way through the other. sim3d/bullet/
# holds replacements of Bullet's own classes and is left out.
set -eu
# Names that only one of them has: what one engine needs and the other does not (Box2D's user data, its records of
# contacts, its impulses that die with a contact, its rule for restitution, its search for times of impact; Bullet's unit of mass, its plane and the
# friction that its points remember).
only_one='(tag|contact_records|warm_start|materials|continuous|bodies|engine|mass_scale|pieces|plane|friction_impulse)\.h'

headers() { git ls-files "$1/*.h" | sed "s|^$1/||" | grep -v '^bullet/' | grep -vxE "$only_one" | LC_ALL=C sort | tr '\n' ' '; }
in_2d=$(headers sim2d)
in_3d=$(headers sim3d)
[ "$in_2d" = "$in_3d" ] && [ -n "$in_2d" ] && exit 0
echo "sim2d/ has: $in_2d"
echo "sim3d/ has: $in_3d"
exit 1
