#!/bin/bash
# Builds and tests the workspace by plain colcon with the versions of Ubuntu 24.04, where ROS 2 Jazzy
# is at home: Python 3.12, numpy 1.26, setuptools 68. ROS itself comes from wheels.
#
#   tests/tools/setups/native_colcon.sh                                   all tests
#   tests/tools/setups/native_colcon.sh --packages-select push_node       arguments for `colcon test`
#
# PYTHON names the interpreter (default: a Python 3.12 on the PATH or of pyenv). What is committed is
# tested, in a clone below .cache. The status is 1 where a test fails; colcon's own output is in
# ros2_ws/log of the clone.
# shellcheck source-path=SCRIPTDIR/../../scripts/setup
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../../.." && pwd -P)
root=$here/.cache/native
readonly STAMPS=$root/.venv/.stamps
. "$here/scripts/setup/versions.sh"
. "$here/scripts/setup/ros.sh"
export PUSH_DATA_DIR=${PUSH_DATA_DIR:-$here/../shared/data}

main() {
  [ -e "$root" ] || git clone --quiet --shared --no-checkout "$here" "$root"
  git -C "$root" checkout --quiet --force --detach "$(git -C "$here" rev-parse HEAD)"
  PYTHON=${PYTHON:-$(find_version 3.12)} "$root/scripts/setup.sh" packages
  use_versions_of_ubuntu
  use_wheels
  export VIRTUAL_ENV=$root/.venv PATH=$root/.venv/bin:$PATH OPENBLAS_NUM_THREADS=1
  build_and_test "$@"
}

use_versions_of_ubuntu() {
  # contourpy, of matplotlib, is the last one that takes numpy 1
  "$root/.venv/bin/python" -m pip install --quiet numpy==1.26.4 setuptools==68.1.2 contourpy==1.3.2
  # the CMake files of the wheels name numpy's headers, which lay elsewhere before numpy 2
  find "$root/.venv/share" -name '*Export.cmake' -exec sed -i 's|numpy/_core/include|numpy/core/include|g' {} +
}

build_and_test() {
  cd "$root/ros2_ws"
  rm -rf build install log
  colcon build --symlink-install --cmake-args "-DPython3_EXECUTABLE=$VIRTUAL_ENV/bin/python"
  set +u
  # shellcheck source=/dev/null
  . install/local_setup.bash
  set -u
  colcon test "$@" || true
  colcon test-result --verbose
}

main "$@"
