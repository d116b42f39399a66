#!/bin/sh
# Writes the lock files anew from the *.in files; needs uv (https://docs.astral.sh/uv).
# One lock serves Python 3.10 to 3.13 by environment markers.
set -eu
cd "$(dirname "$0")"
for purpose in run dev ros; do
  uv pip compile --quiet --universal --python-version 3.10 --no-header --no-emit-index-url \
    --fork-strategy requires-python "$purpose.in" --output-file "$purpose.txt" "$@"
done
