# shellcheck shell=bash
# The virtual environment. Each finished step leaves a stamp with the key of what was asked for, so
# that an interrupted set-up goes on where it stopped. A changed lock starts a fresh environment, but
# that of the tools of tests and lint, which is installed over the one before.

readonly STAMPS=$root/.venv/.stamps

# key_of_environment: changes when the environment has to be made anew.
key_of_environment() {
  { printf '%s\n' "$ros" "$root"; cat "$root"/requirements/{ros,run}.txt "$scripts"/setup/*.py; } | sha256sum
}

stamp() {
  key_of "$1" > "$STAMPS/$1.new"
  mv "$STAMPS/$1.new" "$STAMPS/$1"
}

is_stamped() {
  [ "$(cat "$STAMPS/$1" 2> /dev/null)" = "$(key_of "$1")" ]
}

# key_of STAMP
key_of() {
  if [ "$1" = dev ]; then sha256sum < "$root/requirements/dev.txt"; else printf '%s\n' "$environment_key"; fi
}

# has_interpreter: whether the environment's Python is still the one that it was made with.
has_interpreter() {
  [ -x "$root/.venv/bin/python" ] &&
    [ "$(cat "$STAMPS/interpreter" 2> /dev/null)" = "$(readlink -f "$root/.venv/bin/python")" ] &&
    is_asked_for "$root/.venv/bin/python"
}

# is_asked_for INTERPRETER: whether it is the one that PYTHON= names, if that is set.
is_asked_for() {
  [ -z "${PYTHON:-}" ] || [ "$(real_python "$PYTHON")" = "$(readlink -f "$1")" ]
}

real_python() {
  "$1" -c 'import os, sys; print(os.path.realpath(sys.executable))' 2> /dev/null
}

# create_environment PYTHON: a fresh .venv, with a view of the distribution's packages where the
# sourced ROS keeps its build tools there.
create_environment() {
  local -a view=()
  [ "$ros" = wheels ] || view=(--system-site-packages)
  rm -rf "$root/.venv"
  "$1" -m venv "${view[@]}" "$root/.venv" > "$logs/venv.log" 2>&1 ||
    fail "no virtual environment: $(tail -n 1 "$logs/venv.log")"
  mkdir "$STAMPS"
  printf '%s\n' "$ros" > "$STAMPS/ros"
  readlink -f "$root/.venv/bin/python" > "$STAMPS/interpreter"
  stamp created
}

# install_locks STAMP LOCK…: what the locks name, to the letter: they are complete, nothing is resolved.
install_locks() {
  local name=$1 lock
  local -a files=()
  shift
  for lock; do files+=(--requirement "$root/requirements/$lock.txt"); done
  "$root/.venv/bin/python" -I "$scripts/setup/forget_half_installed.py"
  install_by_uv "$name" "${files[@]}" || install_by_pip "$name" --no-deps --no-compile "${files[@]}"
  [ "$name" != wheels ] || relocate_ros
  stamp "$name"
}

# install_by_uv NAME ARGUMENT…: seconds instead of a minute, where uv is at hand and reaches an index.
# It copies: links would lead what relocate_ros writes into uv's cache.
install_by_uv() {
  local log=$logs/uv-$1.log
  shift
  command -v uv > /dev/null || return
  uv pip install --python "$root/.venv/bin/python" --no-deps --link-mode copy --no-progress "$@" \
    > "$log" 2>&1 || { echo "uv failed, pip goes on ($log)"; return 1; }
}

# install_by_pip NAME ARGUMENT…
install_by_pip() {
  local log=$logs/pip-$1.log
  shift
  run_pip install --progress-bar off "$@" > "$log" 2>&1 || fail "$(pip_failure "$log")"
}

run_pip() {
  PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1 "$root/.venv/bin/python" -I -m pip "$@"
}

# install_extra NAME: an optional part, kept once it is there. What a build of torch for a GPU needs
# on top is not in the lock, so that dependencies are followed here.
install_extra() {
  local lock=$root/requirements/extra/$1.txt known
  if [ ! -f "$lock" ]; then
    known=$(cd "$root/requirements/extra" && printf '%s ' *.txt)
    fail "there is no extra '$1'; there is: ${known//.txt/}"
  fi
  cmp -s "$lock" "$STAMPS/extra-$1" && return
  step "extra packages: $1"
  install_by_pip "extra-$1" --requirement "$lock"
  cp "$lock" "$STAMPS/extra-$1"
}

# compile_packages: what the nodes import at every start; pip would compile everything, one by one.
compile_packages() {
  local site name
  local -a folders=()
  site=$("$root/.venv/bin/python" -I -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
  for name in numpy scipy osqp jinja2 joblib yaml mcap zstandard tqdm narwhals _plotly_utils plotly \
    rclpy rpyutils ament_index_python builtin_interfaces rcl_interfaces std_msgs std_srvs \
    geometry_msgs diagnostic_msgs visualization_msgs rosgraph_msgs; do
    [ ! -d "$site/$name" ] || folders+=("$site/$name")
  done
  "$root/.venv/bin/python" -I -m compileall -q -j "$(nproc)" -x '/tests?/|plotly/validators' \
    "${folders[@]}" > "$logs/compile.log" 2>&1 || true
}

# relocate_ros: makes the wheels a prefix that CMake, colcon and the loader understand.
relocate_ros() {
  local shell
  _ROS_WHEELS_BOOTSTRAP_COMPLETE=1 "$root/.venv/bin/python" -I "$scripts/setup/relocate_ros.py"
  for shell in sh bash zsh; do
    echo '# env.sh sets what this prefix needs; colcon asks for the file.' > "$root/.venv/local_setup.$shell"
  done
  find "$root/.venv/lib" -maxdepth 3 -type d -name 'ros_*.libs' -printf ':%p' > "$STAMPS/libraries"
}

# pip_failure LOG: the one line that says what to do.
pip_failure() {
  if grep -q 'No space left' "$1"; then
    echo 'the disk is full: make room and run it again, it goes on where it stopped'
  elif is_out_of_reach "$1"; then
    echo "no package index within reach: check network and proxy, run it again, it goes on where it stopped ($1)"
  else
    echo "pip failed: $(grep '^ERROR' "$1" | tail -n 1) ($1)"
  fi
}

is_out_of_reach() {
  grep -qE 'Retrying|Connection|Timeout|ProxyError|SSLError|Network is unreachable' "$1"
}
