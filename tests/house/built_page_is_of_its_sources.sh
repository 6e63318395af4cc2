# The browser page in tools/view/page/dist is built from the sources beside it: `./dev page` builds it. Needs no node; that
# the build itself gives these bytes is a test of preset `browser`.
set -eu
cd tools/view/page
sha256sum --quiet --check dist/checksums.sha256
tracked=$(git ls-files . | grep -v -e '^dist/checksums' -e '^test/' -e '^\.' | sort)
listed=$(cut -c67- dist/checksums.sha256 | sort)
[ "$tracked" = "$listed" ] && exit 0
printf 'dist/checksums.sha256 is not of these files:\n%s\n' "$tracked"
exit 1
