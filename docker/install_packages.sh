#!/bin/sh
# Installs packages of the distribution in an image, and leaves no lists behind.
set -eu
apt-get update
apt-get install --yes --no-install-recommends "$@"
rm -rf /var/lib/apt/lists/*
