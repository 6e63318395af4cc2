# Each relative link of a Markdown page leads to a tracked file, and to a heading of it where it names one.
set -eu
headings() { # the anchors of a page
  sed '/^```/,/^```/d' "$1" | sed -n 's/^##* //p' | tr 'A-Z' 'a-z' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}
failed=0
for page in $(git ls-files '*.md'); do
  for target in $(sed '/^```/,/^```/d' "$page" | grep -oE '\]\([^): ]+\)' | sed 's,^..,,; s,.$,,' | sort -u); do
    file=${target%%#*}
    path=$page
    [ -z "$file" ] || path=$(dirname "$page")/$file
    if [ -z "$(git ls-files "$path")" ]; then
      echo "$page links to $target, which is not there"
      failed=1
    elif [ "$target" != "$file" ] && ! headings "$path" | grep -qxF "${target#*#}"; then
      echo "$page links to $target, but that page has no such heading"
      failed=1
    fi
  done
done
exit $failed
