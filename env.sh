# shellcheck shell=bash
# Opens the environment of the pushing cell in bash or zsh: `source env.sh`, from any folder.

# _push_prepend NAME FOLDER: puts FOLDER first in the search path NAME, once.
_push_prepend() {
  _push_paths=
  eval "_push_paths=\${$1:-}"
  case ":$_push_paths:" in
    *":$2:"*) ;;
    *) export "$1=$2${_push_paths:+:$_push_paths}" ;;
  esac
}

# _push_check ROOT: says in one line what is missing, if anything.
_push_check() {
  if [ ! -e "$1/.venv/.stamps/packages" ] || [ ! -e "$1/ros2_ws/install/local_setup.bash" ]; then
    echo "env.sh: the cell is not set up: run 'make setup' in $1 first" >&2
    return 1
  fi
  _push_ros=$(cat "$1/.venv/.stamps/ros")
  if [ "$_push_ros" != wheels ] && [ -z "${ROS_DISTRO:-}" ]; then
    echo "env.sh: the cell stands on the ROS 2 of $_push_ros: source its setup file first" >&2
    return 1
  fi
}

# _push_open_wheels PREFIX: what a sourced ROS would have set.
_push_open_wheels() {
  _push_prepend AMENT_PREFIX_PATH "$1"
  _push_prepend CMAKE_PREFIX_PATH "$1"
  _push_prepend LD_LIBRARY_PATH "$1/lib$(cat "$1/.stamps/libraries")"
  # the wheels would start every Python twice to set this path themselves
  export _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
}

# _push_open_workspace FOLDER: colcon's own script, which does not bear `set -u`.
_push_open_workspace() {
  case $- in *u*) _push_strict=-u ;; *) _push_strict=+u ;; esac
  set +u
  # shellcheck source=/dev/null
  if [ -n "${ZSH_VERSION:-}" ]; then . "$1/local_setup.zsh"; else . "$1/local_setup.bash"; fi
  set "$_push_strict"
}

# _push_open ROOT: sets everything, the more specific first in each path.
_push_open() {
  export VIRTUAL_ENV="$1/.venv"
  _push_prepend PATH "$1/.venv/bin"
  [ "$_push_ros" != wheels ] || _push_open_wheels "$1/.venv"
  _push_open_workspace "$1/ros2_ws/install"
  export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
  export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}"
  # last in the path: a real ros2 goes before the stand-in
  case ":$PATH:" in *":$1/scripts/bin:"*) ;; *) export PATH="$PATH:$1/scripts/bin" ;; esac
}

_push_root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE:-$0}")" && pwd -P)
if _push_check "$_push_root" && _push_open "$_push_root"; then _push_status=0; else _push_status=1; fi
unset -f _push_prepend _push_check _push_open_wheels _push_open_workspace _push_open
unset _push_root _push_paths _push_ros _push_strict
# the last command is the status of `source`; its variable must not outlive it
eval "unset _push_status; return $_push_status"
