# The manual, README.md and docs/*.md, has at most ten pages in docs/ and 31,500 words.
set -eu
export LC_ALL=C.UTF-8 # wc counts words by the locale
pages=$(git ls-files 'docs/*.md' | grep -c '^docs/[^/]*$')
words=$(git ls-files README.md 'docs/*.md' | grep -v "^docs/.*/" | xargs cat | tr -d "|" | wc -w) # bars of tables are no words
[ "$pages" -le 10 ] && [ "$words" -le 31500 ] && exit 0
echo "The manual has $pages pages in docs/ and $words words."
exit 1
