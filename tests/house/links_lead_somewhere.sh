# Each relative link of a Markdown page leads to a tracked file.
set -eu
failed=0
for page in $(git ls-files '*.md'); do
  for target in $(grep -oE '\]\([^)#: ]+[)#]' "$page" | sed 's,^..,,; s,.$,,' | sort -u); do
    git ls-files --error-unmatch "$(dirname "$page")/$target" >/dev/null 2>&1 && continue
    [ -n "$(git ls-files "$(dirname "$page")/$target")" ] && continue
    echo "$page links to $target, which is not there"
    failed=1
  done
done
exit $failed
