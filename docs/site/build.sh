#!/usr/bin/env bash
# Builds the documentation as a site, without warnings. Needs Sphinx with MyST and Furo, Doxygen, Breathe, and the Python
# package of Rimline (PYTHONPATH=build/release/python).
#
#   docs/site/build.sh FOLDER [PYTHON]     FOLDER/html/index.html is the site
set -eu

folder=${1:?usage: docs/site/build.sh FOLDER [PYTHON]}
python=${2:-python3}
root=$(cd "$(dirname "$0")/../.." && pwd)
"$python" -c 'import breathe, furo, myst_parser, sphinx' 2>/dev/null && command -v doxygen >/dev/null || {
    echo "SKIPPED: no Sphinx with MyST, Furo and Breathe, or no Doxygen"
    exit 77
}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
rm -rf "$folder/doxygen" "$folder/html" "$folder/doctrees"

cd "$root"
headers=$(sed -n 's/^ *\(\(silhouette\|engine\)\/[a-z_\/]*\.h\)$/\1/p' tools/package/public_headers.cmake | grep -v "^silhouette/rimline.h" | tr "\n" " ")
{
    cat docs/site/Doxyfile
    echo "INPUT = tools/c/rimline.h $headers"
    echo "OUTPUT_DIRECTORY = $folder/doxygen"
} >"$folder/Doxyfile"
mkdir -p "$folder/doxygen"
doxygen "$folder/Doxyfile"
RIMLINE_SITE_XML=$folder/doxygen/xml \
    "$python" -B -m sphinx -W --keep-going -q -b html -d "$folder/doctrees" -c docs/site docs "$folder/html"
