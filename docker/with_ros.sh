#!/usr/bin/env bash
# Runs a command on the ROS of the image, where it has one; ROS_SETUP names another setup file.
# shellcheck source=/dev/null
[ -n "${ROS_DISTRO:-}" ] && [ -r "${ROS_SETUP:=/opt/ros/$ROS_DISTRO/setup.bash}" ] && . "$ROS_SETUP"
exec "$@"
