#!/usr/bin/env bash
# One lap with a container for each node; bag, score and report are left in runs/ (or RUNS), owned by
# whoever runs this. docker/.env has what can be chosen.
set -euo pipefail
folder=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
RUNS=${RUNS:-$(dirname -- "$folder")/runs}
CELL_UID=${SUDO_UID:-$(id -u)}
mkdir -p "$RUNS"
if [ "$CELL_UID" = 0 ]; then
  # the containers have no root
  CELL_UID=1000
  chown "$CELL_UID" "$RUNS"
fi
export RUNS CELL_UID
exec docker compose --file "$folder/compose.yaml" --profile demo up --build --exit-code-from lap "$@"
