#!/usr/bin/env bash
# Runs the demo and the tests on every Python that serves and is found, on the PATH or by pyenv, each
# in a clone and an environment of its own below .cache/matrix: one line of result for each. PYTHONS=…
# picks the versions. What is not committed is tested as well, but for files that git does not know.
# shellcheck source-path=SCRIPTDIR
set -euo pipefail

scripts=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$(dirname -- "$scripts")
. "$scripts/setup/say.sh"
. "$scripts/setup/ros.sh"
. "$scripts/setup/versions.sh"
pythons=${PYTHONS:-3.10 3.11 3.12 3.13}
clones=$root/.cache/matrix

main() {
  local version python status=0
  forget_own_prefixes
  mkdir -p "$clones"
  PUSH_DATA_DIR=${PUSH_DATA_DIR:-$(cd -- "$root/.." && pwd -P)/shared/data}
  export PUSH_DATA_DIR
  for version in $pythons; do
    python=$(find_version "$version")
    if [ -n "$python" ]; then
      run_version "$version" "$python" || status=1
    else
      printf '%-5s not found\n' "$version"
    fi
  done
  return "$status"
}

run_version() {
  local clone=$clones/$1
  update_clone "$clone"
  printf '%-5s demo %s, tests %s\n' "$1" \
    "$(outcome_of demo "$clone" "$2")" "$(outcome_of test "$clone" "$2")" | tee "$clone.line"
  ! grep -q failed "$clone.line"
}

# update_clone CLONE: to what the work tree holds; its environment is kept.
update_clone() {
  local commit
  commit=$(git -C "$root" stash create)
  [ -e "$1" ] || git clone --quiet --shared --no-checkout "$root" "$1"
  git -C "$1" checkout --quiet --force --detach "${commit:-$(git -C "$root" rev-parse HEAD)}"
}

# outcome_of TARGET CLONE PYTHON: in a few words; all that it wrote is in CLONE.TARGET.log. What is
# started in the background ignores SIGINT, which the tests send.
outcome_of() {
  local word=passed begin=$SECONDS
  PYTHON=$3 env --default-signal=INT make -C "$2" "$1" > "$2.$1.log" 2>&1 < /dev/null || word="failed ($2.$1.log)"
  printf '%s in %d s' "$word" $((SECONDS - begin))
}

main
