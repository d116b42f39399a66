#!/usr/bin/env bash
# Runs a command in the cell's environment, on the ROS that the set-up used; ROS_SETUP names another.
# shellcheck source=/dev/null
[ -n "${ROS_DISTRO:-}" ] && [ -r "${ROS_SETUP:=/opt/ros/$ROS_DISTRO/setup.bash}" ] && . "$ROS_SETUP"
exec "$(dirname -- "${BASH_SOURCE[0]}")/../scripts/in_env" "$@"
