# shellcheck shell=bash
# Which ROS the cell stands on: the sourced one, otherwise the wheels.

# forget_own_prefixes: takes this project out of the search paths, so that set-up sees the same
# shell before and after `source env.sh`.
forget_own_prefixes() {
  local name
  for name in AMENT_PREFIX_PATH CMAKE_PREFIX_PATH COLCON_PREFIX_PATH PYTHONPATH LD_LIBRARY_PATH PATH; do
    export "$name=$(without_own_folders "${!name:-}")"
    [ -n "${!name}" ] || unset "$name"
  done
}

# without_own_folders PATHS: the colon-separated PATHS outside this project.
without_own_folders() {
  local folder kept=''
  local -a folders
  IFS=: read -ra folders <<< "$1"
  for folder in "${folders[@]}"; do
    case $folder in
      "$root"/* | '') ;;
      *) kept=$kept${kept:+:}$folder ;;
    esac
  done
  printf '%s' "$kept"
}

# choose_ros: writes the prefix of the sourced ROS 2 Jazzy, or `wheels`.
choose_ros() {
  case ${ROS_DISTRO:-} in
    '') echo wheels ;;
    jazzy) prefix_of_rclpy ;;
    *) fail "ROS 2 $ROS_DISTRO is sourced, the cell needs jazzy: open a shell without it" ;;
  esac
}

prefix_of_rclpy() {
  local prefix
  local -a prefixes
  IFS=: read -ra prefixes <<< "${AMENT_PREFIX_PATH:-}"
  for prefix in "${prefixes[@]}"; do
    if [ -e "$prefix/share/ament_index/resource_index/packages/rclpy" ]; then
      printf '%s\n' "$prefix"
      return
    fi
  done
  echo 'setup: ROS_DISTRO is jazzy but AMENT_PREFIX_PATH holds no rclpy: using the wheels' >&2
  echo wheels
}

# use_wheels: the search paths of the wheels' prefix.
use_wheels() {
  LD_LIBRARY_PATH=$root/.venv/lib$(cat "$STAMPS/libraries")
  export AMENT_PREFIX_PATH=$root/.venv CMAKE_PREFIX_PATH=$root/.venv
  export LD_LIBRARY_PATH _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
}
