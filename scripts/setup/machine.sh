# shellcheck shell=bash
# What the machine must offer, each lack told in one line.

# those first for which PyBullet need not be compiled
readonly WHEEL_PYTHONS='python3.11 python3.10 python3 python3.12 python3.13'
readonly ROS_PYTHONS='python3 python3.12'
readonly NEEDED_MEGABYTES=2500

# check_machine PYTHON: fails where the set-up could not succeed.
check_machine() {
  check_folder
  check_disk
  check_compiler
  check_python_parts "$1"
}

check_folder() {
  case $root in
    *[[:space:]]*) fail "CMake cannot build below '$root': move the project to a path without spaces" ;;
  esac
  [ -w "$root" ] || fail "$root is not writable: move the project or change its owner"
}

check_disk() {
  local free
  free=$(df -Pm "$root" | awk 'NR == 2 { print $4 }')
  [ "$free" -ge "$NEEDED_MEGABYTES" ] ||
    fail "$free MB are free for $root, $NEEDED_MEGABYTES MB are needed: make room"
}

check_compiler() {
  command -v "${CXX:-c++}" > /dev/null || fail 'no C++ compiler: install one (sudo apt install g++)'
  command -v "${CC:-cc}" > /dev/null || fail 'no C compiler: install one (sudo apt install gcc)'
  command -v make > /dev/null || fail 'no make: install it (sudo apt install make)'
}

check_python_parts() {
  local version
  version=$(python_version "$1")
  "$1" -c 'import ensurepip, venv' 2> /dev/null ||
    fail "Python $version has no venv module: install it (sudo apt install python$version-venv)"
  "$1" -c 'import pathlib, sysconfig
raise SystemExit(not pathlib.Path(sysconfig.get_paths()["include"], "Python.h").exists())' ||
    fail "Python $version has no headers: install them (sudo apt install python$version-dev)"
}

python_version() {
  "$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2> /dev/null
}

# find_python: writes the interpreter for the environment; PYTHON=… overrides the search.
find_python() {
  local name
  local -a names
  case $ros in
    wheels) read -ra names <<< "${PYTHON:-$WHEEL_PYTHONS}" ;;
    *) read -ra names <<< "${PYTHON:-$ROS_PYTHONS}" ;;
  esac
  for name in "${names[@]}"; do
    if serves "$name"; then
      "$name" -c 'import sys; print(sys.executable)'
      return
    fi
  done
  fail "$(wanted_python), found neither under ${names[*]}: install it or set PYTHON="
}

# serves NAME: whether this interpreter can run the cell.
serves() {
  case $ros in
    wheels) case $(python_version "$1") in 3.1[0-3]) ;; *) return 1 ;; esac ;;
    *) "$1" -c 'from rclpy.experimental import EventsExecutor' 2> /dev/null ;;
  esac
}

wanted_python() {
  case $ros in
    wheels) echo 'Python 3.10, 3.11, 3.12 or 3.13 is needed' ;;
    *) echo "a Python that imports the rclpy of $ros, 7.1.4 or newer, is needed" ;;
  esac
}
