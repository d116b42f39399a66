# The two commands a user needs are `make demo` and `make test`; both set up what they need, once.
SHELL := /bin/bash
UNIT_TESTS := $(wildcard ros2_ws/src/*/test)
PYTEST := scripts/in_env pytest -p no:cacheprovider
SHELL_SCRIPTS := env.sh scripts/*.sh scripts/in_env scripts/bin/ros2 docker/*.sh requirements/lock.sh .ci/run tests/tools/setups/fresh_root.sh tests/tools/setups/native_colcon.sh

.DEFAULT_GOAL := help
.PHONY: help demo test matrix bench lint setup clean

help:  ## list the targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-6s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

demo: setup  ## push the square once round the 8-track, record and score it (DATA=pushes.csv trains on your own)
	@DATA='$(DATA)' scripts/in_env scripts/demo.sh

test: setup  ## run every test: of each package, then of the cell as a whole
	@$(PYTEST) -n auto --dist loadfile $(UNIT_TESTS) tests

matrix:  ## demo and tests on every Python found, in clones of their own (PYTHONS='3.12 3.13' picks them)
	@PYTHONS='$(PYTHONS)' scripts/matrix.sh

bench: setup  ## the paper's experiments in process, beside the paper's numbers (about five minutes)
	@scripts/in_env ros2 run push_bringup bench table

lint: setup  ## check style, types, imports, shell scripts, the Dockerfile, compose.yaml and the workflow
	@scripts/in_env ruff check .
	@scripts/in_env ruff format --check .
	@scripts/in_env mypy
	@scripts/in_env mypy examples/*.py
	@scripts/in_env lint-imports --no-logo --no-cache
	@scripts/in_env shellcheck --external-sources --check-sourced $(SHELL_SCRIPTS)
	@scripts/in_env hadolint docker/Dockerfile
	@scripts/in_env yamllint --strict .
	@scripts/in_env check-jsonschema --builtin-schema vendor.compose-spec docker/compose.yaml
	@scripts/in_env check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/ci.yml

setup:  ## set up .venv and build the workspace (PYTHON=python3.12 picks the interpreter, EXTRA=bench adds libraries to compare with, EXTRA=parquet pyarrow)
	@PYTHON='$(PYTHON)' EXTRA='$(EXTRA)' scripts/setup.sh

clean:  ## remove everything that set-up, tests and lint made; runs/ stays
	@rm -rf .venv .cache .hypothesis .mypy_cache .pytest_cache .ruff_cache
	@rm -rf ros2_ws/build ros2_ws/install ros2_ws/log
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
