#!/usr/bin/env bash
# Learns a model from pushes, pushes the square once round the 8-track with it in real time, scores
# the recorded run. DATA=… names the pushes: any CSV in the form that `push_sim collect` writes.
# Needs the environment of env.sh.
set -euo pipefail

cd "$(dirname -- "${BASH_SOURCE[0]}")/.."
cache=.cache/demo
measured=${PUSH_DATA_DIR:-../shared/data}/square_4mm_pushes.csv
mkdir -p "$cache"

main() {
  local data model run
  data=$(choose_data)
  [ -r "$data" ] || fail "DATA=$data cannot be read: name a CSV of pushes"
  model=$(model_for "$data")
  train "$data" "$model"
  run=$(push "$model")
  compare "$run"
}

fail() {
  echo "demo: $1" >&2
  exit 2
}

# choose_data: DATA, the measured pushes where they are at hand, or pushes of the simulator.
choose_data() {
  if [ -n "${DATA:-}" ]; then
    echo "$DATA"
  elif [ -e "$measured" ]; then
    echo "$measured"
  else
    [ -e "$cache/pushes.csv" ] || ros2 run push_sim collect --pushes 400 --seed 0 -o "$cache/pushes.csv" >&2
    echo "$cache/pushes.csv"
  fi
}

# model_for DATA: the file of the model, named by the content of its data.
model_for() {
  echo "$cache/model-$(sha256sum < "$1" | cut -c 1-12).npz"
}

# train DATA MODEL: unless the model is there, and newer than the code that would train it.
train() {
  if [ -e "$2" ] && [ -z "$(find ros2_ws/src/push_gp/push_gp -name '*.py' -newer "$2" -print -quit)" ]; then
    echo "demo: model of 200 pushes out of $1, trained before"
    return
  fi
  echo "demo: learning a model from 200 pushes out of $1"
  ros2 run push_gp train "$1" --points 200 --seed 0 -o "$2"
}

# push MODEL: writes the run's folder, which is the last line of `cell`; shows the rest meanwhile, with
# the score at its end.
push() {
  ros2 run push_bringup cell --track eight --speed 0.08 --controller gp --model "$1" -o runs/ |
    tee >(cat >&2) | tail -n 1
}

# compare RUN: what the paper reached on the real robot, below our score, and where to look.
compare() {
  echo 'paper              mean 8.50 mm (GP, 5000 points), 9.56 mm (analytical); real robot, same track and speed'
  echo
  echo "run     $1"
  echo "json    $1/score.json"
  echo "report  $1/report.html"
}

main
