#!/usr/bin/env bash
# The model server with the model MODEL: a file, `analytical`, or, where none is named, the default
# model, which is learned once and kept in $XDG_CACHE_HOME.
set -euo pipefail
if [ -z "${MODEL:-}" ]; then
  MODEL=$(python -c 'from push_bringup.setup.default_model import default_model; print(default_model())')
fi
exec ros2_ws/install/push_gp/lib/push_gp/gp_server --ros-args -p "model:=$MODEL" "$@"
