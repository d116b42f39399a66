#!/bin/bash
# Runs the project in a fresh Debian root that has the base system and what README asks for, as a
# newcomer would: debootstrap, the prerequisites line of README, then make.
#
#   sudo tests/tools/setups/fresh_root.sh trixie                 make demo, make test
#   sudo tests/tools/setups/fresh_root.sh bookworm demo          one of them
#
# ROOTS names the folder of the roots (default /var/tmp/push_cell_roots); a root that is there is
# used again, without what an earlier run set up. What is committed is run, on the measured data of
# ../shared/data where they are. Needs root, debootstrap and a network; proxies, PIP_CERT and
# ROS_DOMAIN_ID are handed on. Prints one line for each target; its output is beside the root.
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../../.." && pwd -P)
suite=${1:?name a suite: bookworm, trixie}
shift
targets=${*:-demo test}
root=${ROOTS:-/var/tmp/push_cell_roots}/$suite

main() {
  local target status=0
  trap leave EXIT
  [ -e "$root/etc/debian_version" ] || make_root
  enter
  within "apt-get update && apt-get install --yes --no-install-recommends $(prerequisites)" \
    > "$root.apt.log" 2>&1
  copy_project
  for target in $targets; do
    run "$target" || status=1
  done
  return "$status"
}

make_root() {
  mkdir -p "$root"
  debootstrap --variant=minbase "$suite" "$root" > "$root.debootstrap.log"
}

# enter: what a machine has around its files; the chroot shares this machine's network.
enter() {
  mount -t proc proc "$root/proc"
  mount --rbind --make-rslave /dev "$root/dev"
  cp /etc/resolv.conf "$root/etc/"
  [ -z "${PIP_CERT:-}" ] || cp "$PIP_CERT" "$root/etc/pip_cert.pem"
}

leave() {
  umount -l "$root/dev" "$root/proc" 2> /dev/null || true
}

copy_project() {
  rm -rf "$root/work"
  mkdir -p "$root/work/shared"
  git -C "$here" archive --prefix=cell/ HEAD | tar -x -C "$root/work"
  [ ! -d "$here/../shared/data" ] || cp -r "$here/../shared/data" "$root/work/shared/"
}

# prerequisites: the packages of README's line.
prerequisites() {
  # shellcheck disable=SC2016 # the backquotes are README's
  sed -n 's/.*(`apt install \([^`]*\)`).*/\1/p' "$here/README.md"
}

# run TARGET: one line says how it ended.
run() {
  local word=passed begin=$SECONDS
  within "cd /work/cell && make $1" > "$root.$1.log" 2>&1 < /dev/null || word="failed ($root.$1.log)"
  printf '%-10s make %-5s %s in %d s\n' "$suite" "$1" "$word" $((SECONDS - begin))
  [ "$word" = passed ]
}

# within COMMAND: as root of the new root, in the environment of a login.
within() {
  local name
  local -a handed_on=()
  for name in http_proxy https_proxy no_proxy ROS_DOMAIN_ID; do
    [ -z "${!name:-}" ] || handed_on+=("$name=${!name}")
  done
  [ -z "${PIP_CERT:-}" ] || handed_on+=(PIP_CERT=/etc/pip_cert.pem)
  chroot "$root" env -i --default-signal=INT HOME=/root LANG=C.UTF-8 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "${handed_on[@]}" bash -c "$1"
}

main
