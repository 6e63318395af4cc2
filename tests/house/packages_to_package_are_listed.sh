# What dpkg-buildpackage requires is in the list that ./dev packages installs: the build dependencies of debian/control and
# build-essential. pkgconf comes with libcairo2-dev.
set -eu
listed=$(sed -n '/^\[build\]/,/^\[test\]/p; /^\[package\]/,/^\[browser\]/p' .ci/debian-packages.txt | sed 's/ .*//')
failed=0
for package in build-essential $(sed -n '/^Build-Depends:/,/^$/p' debian/control | sed 's/^Build-Depends://; s/([^)]*)//g' | tr -d ','); do
  case $package in
    debhelper-compat) package=debhelper ;;
    dh-sequence-python3) package=dh-python ;;
    pkgconf) continue ;;
  esac
  if ! echo "$listed" | grep -qxF "$package"; then
    echo "dpkg-buildpackage requires $package, which is not in .ci/debian-packages.txt"
    failed=1
  fi
done
exit $failed
