# Each declaration in include/talus/ has a docstring that Doxygen understands.
set -eu
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
{ cat include/Doxyfile; echo "OUTPUT_DIRECTORY = $folder"; } | doxygen -
