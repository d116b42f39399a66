# shellcheck shell=bash
# The workspace, built by colcon with symbolic links: edits of Python sources take effect at once, so
# a package is built anew only when what its installation depends on has changed.

readonly WORKSPACE=$root/ros2_ws

# stale_packages: names those whose installation does not match their sources.
stale_packages() {
  local manifest name
  for manifest in "$WORKSPACE"/src/*/package.xml; do
    name=$(basename "$(dirname "$manifest")")
    is_built "$name" || echo "$name"
  done
}

is_built() {
  [ "$(cat "$(built_stamp "$1")" 2> /dev/null)" = "$(package_key "$1")" ] && is_linked "$1"
}

built_stamp() {
  echo "$WORKSPACE/install/$1/.built"
}

# is_linked NAME: false where a plain `colcon build` has put a copy in the link's place.
is_linked() {
  [ ! -e "$WORKSPACE/src/$1/setup.py" ] ||
    compgen -G "$WORKSPACE/install/$1/lib/python*/site-packages/*.egg-link" > /dev/null
}

# package_key NAME: of all interfaces, or of what a linked Python package installs.
package_key() (
  cd "$WORKSPACE/src/$1" || exit
  echo "$environment_key"
  if [ -e setup.py ]; then
    sha256sum setup.py setup.cfg package.xml
    find . -type f ! -name '*.pyc' -regex '\./\(resource\|config\|launch\)/.*' | LC_ALL=C sort
  else
    find . -type f | LC_ALL=C sort | xargs sha256sum
  fi
)

# build_packages NAME…: from scratch; an interrupted build may hold half-written objects.
build_packages() {
  local name status=0
  declare -A keys
  for name; do
    keys[$name]=$(package_key "$name")
    rm -rf "$WORKSPACE/build/$name" "$WORKSPACE/install/$name"
  done
  run_colcon "$@" > "$logs/colcon.log" 2>&1 || status=$?
  for name; do
    [ "$(cat "$WORKSPACE/build/$name/colcon_build.rc" 2> /dev/null)" = 0 ] || continue
    hold_interrupts_of "$name"
    printf '%s\n' "${keys[$name]}" > "$(built_stamp "$name")"
  done
  return "$status"
}

# hold_interrupts_of NAME: lets Ctrl-C wait for push_core.console; while Python itself starts it would
# print a traceback.
hold_interrupts_of() {
  local script
  for script in "$WORKSPACE/install/$1/lib/$1"/*; do
    [ ! -f "$script" ] || sed -i '1s|^#!\(/.*python[^ ]*\)$|#!/usr/bin/env -S --block-signal=INT \1|' "$script"
  done
}

run_colcon() (
  cd "$WORKSPACE" || exit
  export PATH=$root/.venv/bin:$PATH
  [ "$ros" != wheels ] || use_wheels
  # without a load limit, which would leave one of two busy cores unused
  MAKEFLAGS=-j$(nproc)
  export MAKEFLAGS
  "$root/.venv/bin/python" -m colcon --log-base log build --symlink-install --packages-select "$@" \
    --cmake-args "-DPython3_EXECUTABLE=$root/.venv/bin/python"
)

# build_failure: the one line that says where to look.
build_failure() {
  local reason
  reason=$(grep -m 1 -iE 'error|failed' "$logs/colcon.log" || tail -n 1 "$logs/colcon.log")
  echo "colcon build failed: $reason ($logs/colcon.log)"
}
