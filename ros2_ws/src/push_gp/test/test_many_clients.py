"""The server with many clients at once, each in a process of its own, over real DDS."""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from push_gp.models.gp_model import GpModel
from push_gp.models.model_file import save_model

pytestmark = pytest.mark.processes

CLIENTS = 8
CROWD = Path(__file__).with_name('crowd.py')
PATIENCE = 120.0  # [s]; nothing but a hang takes that long


@pytest.fixture
def server(model: GpModel, tmp_path: Path) -> Iterator[subprocess.Popen[bytes]]:
    save_model(tmp_path / 'model.npz', model)
    options = ['--ros-args', '-p', f'model:={tmp_path / "model.npz"}']
    process = subprocess.Popen([sys.executable, '-m', 'push_gp.server.gp_server', *options])
    yield process
    process.terminate()
    assert process.wait(PATIENCE) == 0


@pytest.mark.usefixtures('server')
def test_each_of_many_clients_is_answered_right_while_one_of_them_is_killed(
    model: GpModel,
) -> None:
    generator = np.random.default_rng(6)
    questions = generator.uniform([[-0.04], [0.3]], [[0.04], [2.8]], (CLIENTS, 2, 10))
    crowd = subprocess.run(
        [sys.executable, str(CROWD)],
        input=json.dumps(questions.tolist()),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        timeout=PATIENCE,
    )
    answers = json.loads(crowd.stdout)
    assert len(answers) == CLIENTS - 1
    for (p_y, beta), rounds in zip(questions[1:], answers, strict=True):
        mean, _ = model.evaluate(p_y, beta)
        assert rounds
        for found in rounds:
            assert np.allclose(np.reshape(found, (10, 3)), mean, rtol=1e-9, atol=1e-12)
