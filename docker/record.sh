#!/usr/bin/env bash
# Records into a new folder of /runs (or RUNS); when it is stopped, it finishes the bag, scores it and
# writes the report beside it.
set -euo pipefail

main() {
  local folder recorder
  folder=$(new_folder "${RUNS:-/runs}")
  ros2_ws/install/push_bag/lib/push_bag/recorder --ros-args -p "folder:=$folder" &
  recorder=$!
  # not SIGINT: what a shell starts in the background ignores it from birth
  trap 'kill -TERM "$recorder"' INT TERM
  # a trap ends `wait`, not the recorder
  while kill -0 "$recorder" 2> /dev/null; do wait "$recorder" || true; done
  score "$folder" --json > "$folder/score.json.new"
  mv "$folder/score.json.new" "$folder/score.json"
  score "$folder" --html "$folder/report.html"
  echo "run     $folder"
}

score() {
  ros2_ws/install/push_bag/lib/push_bag/score "$@"
}

# new_folder RUNS: named after the time, and after a number where that is taken.
new_folder() {
  local name number=2
  name=$1/$(date +%Y%m%d-%H%M%S)_containers
  local folder=$name
  while [ -e "$folder" ]; do
    folder=${name}_$number
    number=$((number + 1))
  done
  echo "$folder"
}

main
