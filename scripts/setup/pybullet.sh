# shellcheck shell=bash
# PyBullet, whose last release has wheels for Python 3.10 and 3.11 alone. For any other it is
# compiled, once: the wheel stays in the user's cache, where `make clean` and other clones find it.

# how many objects its build makes, about
readonly PYBULLET_OBJECTS=266
readonly PROGRESS_PERIOD=${PROGRESS_PERIOD:-30}

# install_pybullet: the wheel of the cache or of the index, otherwise one that is compiled.
install_pybullet() {
  local pin folder wheel
  is_stamped pybullet && return
  pin=$(grep '^pybullet==' "$root/requirements/run.txt")
  folder=$(wheel_folder)
  "$root/.venv/bin/python" -I "$scripts/setup/forget_half_installed.py"
  wheel=$(cached_wheel "$folder" "${pin#*==}")
  if [ -z "$wheel" ] && ! install_indexed_wheel "$pin"; then
    compile_pybullet "$pin" "$folder"
    wheel=$(cached_wheel "$folder" "${pin#*==}")
  fi
  [ -z "$wheel" ] || install_by_uv pybullet "$wheel" || install_by_pip pybullet --no-deps --no-compile "$wheel"
  stamp pybullet
}

# wheel_folder: in the user's cache, or in the project's where the user has none that can be written.
# What is compiled here needs a C library at least as new.
wheel_folder() {
  local cache=${XDG_CACHE_HOME:-${HOME:-$root}/.cache} libc folder
  libc=$("$root/.venv/bin/python" -I -c 'import platform; print("-".join(platform.libc_ver()))')
  for folder in "$cache/push_cell/wheels/$libc" "$root/.cache/wheels/$libc"; do
    if mkdir -p "$folder" 2> /dev/null && [ -w "$folder" ]; then
      echo "$folder"
      return
    fi
  done
  fail "$folder cannot be made: change the owner of $root/.cache"
}

# cached_wheel FOLDER VERSION: the wheel for the environment's Python, if there is one.
cached_wheel() {
  local tag
  tag=cp$(python_version "$root/.venv/bin/python" | tr -d .)
  compgen -G "$1/pybullet-$2-$tag-*.whl" || true
}

# install_indexed_wheel PIN: false where the index has no wheel for this Python.
install_indexed_wheel() {
  local log=$logs/pip-pybullet.log
  run_pip install --no-deps --no-compile --only-binary pybullet --progress-bar off "$1" > "$log" 2>&1 && return
  ! is_out_of_reach "$log" || fail "$(pip_failure "$log")"
  return 1
}

# compile_pybullet PIN FOLDER: into FOLDER, one set-up of this user at a time. A half-made wheel stays
# in the folder for the work, which whoever comes next removes.
compile_pybullet() (
  work=$2/unfinished
  exec 8> "$2/lock"
  if ! flock --nonblock 8; then
    echo '          another set-up compiles PyBullet: waiting for it'
    flock 8
  fi
  [ -z "$(cached_wheel "$2" "${1#*==}")" ] || exit 0
  rm -rf "$work"
  mkdir "$work"
  printf '          compiling PyBullet for Python %s, about five minutes, once\n' \
    "$(python_version "$root/.venv/bin/python")"
  build_wheel "$1" "$work" &
  show_progress $! "$work"
  wait $! || fail "$(compile_failure)"
  mv "$work"/pybullet-*.whl "$2/"
  rm -rf "$work"
)

# build_wheel PIN FOLDER: with all cores, by PyBullet's own setup.py, which has no switch for what is
# not used here, but without debugging symbols. The constraint is that of the build's own tools.
build_wheel() {
  export PIP_CONSTRAINT=$root/requirements/run.txt PIP_BUILD_CONSTRAINT=$root/requirements/run.txt
  TMPDIR=$2 CFLAGS="${CFLAGS:-} -g0" run_pip wheel --no-cache-dir --no-deps \
    --no-binary pybullet --wheel-dir "$2" "$1" > "$logs/pip-compile.log" 2>&1
}

# show_progress PROCESS FOLDER: a line every half minute until the build has ended.
show_progress() {
  local waited=0 objects
  while kill -0 "$1" 2> /dev/null; do
    sleep 1
    waited=$((waited + 1))
    [ $((waited % PROGRESS_PERIOD)) = 0 ] || continue
    # files come and go meanwhile
    objects=$({ find "$2" -name '*.o' 2> /dev/null || true; } | wc -l)
    [ "$objects" -ge "$PYBULLET_OBJECTS" ] ||
      printf '          compiling PyBullet: %d %%\n' $((100 * objects / PYBULLET_OBJECTS))
  done
}

compile_failure() {
  local reason
  reason=$(grep -m 1 -E 'error:|No space left' "$logs/pip-compile.log" || tail -n 1 "$logs/pip-compile.log")
  echo "PyBullet does not compile: $reason ($logs/pip-compile.log)"
}
