"""The commands of docker/compose.yaml, run as its containers run them, but without an engine."""

import json
import os
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from string import Template

import pytest
import yaml
from cell_command import HANG
from node_tests import own_domain

ROOT = Path(__file__).parents[1]
SERVICES = yaml.safe_load((ROOT / 'docker/compose.yaml').read_text())['services']
CHOICES = {'CONTROLLER': 'analytical', 'MODEL': 'analytical', 'TRACK': 'line', 'SPEED': '0.1'}
# as in a container; what is started in the background ignores SIGINT, and so do its children
HEARING = ('env', '--default-signal=INT')
NODES = ('recorder', 'sim', 'gp', 'mpc')


def defaults() -> dict[str, str]:
    """What docker/.env has."""
    lines = (ROOT / 'docker/.env').read_text().splitlines()
    return dict(line.split('=', 1) for line in lines if line and not line.startswith('#'))


@pytest.fixture
def environment(environment: dict[str, str], tmp_path: Path) -> dict[str, str]:
    own = {'RUNS': str(tmp_path), 'ROS_DOMAIN_ID': own_domain()}
    return {**environment, **defaults(), **CHOICES, **own}


@pytest.fixture
def nodes(environment: dict[str, str]) -> Iterator[dict[str, 'subprocess.Popen[bytes]']]:
    """The nodes in the order of their services; none is left behind."""
    started = {}
    # a machine that takes the cores away for half a second shall not end the run
    patient = {'mpc': ['-p', 'pose_loss:=10.0']}
    for name in NODES:
        command = [*filled(SERVICES[name]['command'], environment), *patient.get(name, [])]
        started[name] = subprocess.Popen([*HEARING, *command], cwd=ROOT, env=environment)
        wait_until_healthy(name, environment)
    yield started
    for process in started.values():
        process.kill()


def filled(command: list[str], environment: dict[str, str]) -> list[str]:
    return [Template(word).substitute(environment) for word in command]


def wait_until_healthy(name: str, environment: dict[str, str]) -> None:
    word, *check = SERVICES[name]['healthcheck']['test']
    assert word == 'CMD'
    end = time.monotonic() + HANG
    while subprocess.run(check, cwd=ROOT, env=environment, check=False).returncode != 0:
        assert time.monotonic() < end, name


def test_one_lap_leaves_a_scored_run(
    nodes: dict[str, 'subprocess.Popen[bytes]'], environment: dict[str, str], tmp_path: Path
) -> None:
    lap = SERVICES['lap']['command']
    subprocess.run(lap, cwd=ROOT, env=environment, check=True, timeout=HANG)
    for name in reversed(NODES):
        nodes[name].send_signal(signal.SIGINT)
        assert nodes[name].wait(HANG) == 0, name
    (run,) = tmp_path.iterdir()
    assert (run / 'metadata.yaml').exists()
    assert (run / 'report.html').exists()
    assert json.loads((run / 'score.json').read_text())['completed']


def test_a_node_that_is_not_there_is_not_healthy(environment: dict[str, str]) -> None:
    check = SERVICES['mpc']['healthcheck']['test'][1:]
    assert subprocess.run(check, cwd=ROOT, env=environment, check=False).returncode == 1


def test_every_variable_has_a_default() -> None:
    known = {**defaults(), **os.environ}
    text = (ROOT / 'docker/compose.yaml').read_text()
    Template(text).substitute(known)


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        ([], '--profile demo up --build --exit-code-from lap'),
        (['live'], '--profile live up --build'),
    ],
)
def test_the_folder_of_the_runs_is_there_before_the_containers(
    tmp_path: Path, arguments: list[str], words: str
) -> None:
    docker = tmp_path / 'docker'
    docker.write_text('#!/bin/sh\n[ -d "$RUNS" ] && [ "$CELL_UID" != 0 ] && echo "$@"\n')
    docker.chmod(0o755)
    told = subprocess.run(
        [ROOT / 'docker/demo.sh', *arguments],
        env={'PATH': f'{tmp_path}:{os.environ["PATH"]}', 'RUNS': str(tmp_path / 'runs')},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    assert told.stdout == f'compose --file {ROOT}/docker/compose.yaml {words}\n'
