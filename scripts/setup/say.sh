# shellcheck shell=bash
# What set-up tells its user: steps with the time that passed, and failures in one line.

step_count=0
step_total=1

# step WHAT: announces the next step.
step() {
  step_count=$((step_count + 1))
  printf '[%d/%d %4d s] %s\n' "$step_count" "$step_total" "$SECONDS" "$1"
}

# fail WHAT: ends the set-up with one line that says what to do.
fail() {
  printf 'setup: %s\n' "$1" >&2
  exit 1
}
