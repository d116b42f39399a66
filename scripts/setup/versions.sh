# shellcheck shell=bash
# Interpreters by their version.

# find_version VERSION: its interpreter; a shim of pyenv is none where the version is not chosen.
find_version() {
  local name
  for name in "python$1" "${PYENV_ROOT:-${HOME:-}/.pyenv}/versions/$1".*/bin/"python$1"; do
    "$name" -c 'import sys; print(sys.executable)' 2> /dev/null && return
  done
  return 0
}
