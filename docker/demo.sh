#!/usr/bin/env bash
# One lap with a container for each node; bag, score and report are left in runs/ (or RUNS), owned by
# whoever runs this. `docker/demo.sh live` shows it in the browser and goes on until Ctrl-C. docker/.env
# has what can be chosen.
set -euo pipefail
folder=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
profile=${1:-demo}
RUNS=${RUNS:-$(dirname -- "$folder")/runs}
CELL_UID=${SUDO_UID:-$(id -u)}
mkdir -p "$RUNS"
if [ "$CELL_UID" = 0 ]; then
  # the containers have no root
  CELL_UID=1000
  chown "$CELL_UID" "$RUNS"
fi
export RUNS CELL_UID
until_end=()
[ "$profile" != demo ] || until_end=(--exit-code-from lap)
exec docker compose --file "$folder/compose.yaml" --profile "$profile" up --build "${until_end[@]}"
