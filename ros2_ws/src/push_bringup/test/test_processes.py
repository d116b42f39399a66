"""Nodes that are asked to end; here each is a line of Python."""

import time

import pytest
from push_bringup.graph import processes
from push_bringup.graph.processes import Processes

WILLING = "import signal; print('ready', flush=True); signal.sigwait([signal.SIGINT])"
STUBBORN = 'import signal; signal.signal(signal.SIGINT, signal.SIG_IGN); '
STUBBORN += "print('ready', flush=True); signal.sigwait([signal.SIGTERM])"
HANG = 60.0  # [s]


@pytest.fixture
def started(tmp_path, monkeypatch):
    """Starts nodes from their source text."""

    def start(**sources):
        for name, source in sources.items():
            (tmp_path / f'{name}.py').write_text(source)
        monkeypatch.setenv('PYTHONPATH', str(tmp_path))
        modules = {name: name for name in sources}
        nodes = Processes(tmp_path / 'params.yaml', '', tmp_path, modules)
        nodes.start()
        end = time.monotonic() + HANG
        while not all((tmp_path / f'{name}.log').read_text() for name in sources):
            assert time.monotonic() < end
            time.sleep(0.01)
        return nodes

    return start


def test_nodes_that_end_when_asked_are_not_killed(started, capsys) -> None:
    nodes = started(one=WILLING, other=WILLING)
    nodes.stop('one', 'other')
    assert (nodes.status('one'), nodes.status('other')) == (0, 0)
    assert capsys.readouterr().err == ''


def test_a_node_that_does_not_end_is_killed_and_named(started, capsys, monkeypatch) -> None:
    monkeypatch.setattr(processes, 'STOP_TIMEOUT', 0.1)
    with started(stubborn=STUBBORN) as nodes:
        pass
    assert nodes.status('stubborn') == -9
    said = capsys.readouterr().err
    assert said == 'cell: stubborn did not end within 0.1 s and was killed\n'


def test_a_node_that_ended_is_named_with_its_last_line(started) -> None:
    with started(broken="raise SystemExit('no table')") as nodes:
        end = time.monotonic() + HANG
        while nodes.status('broken') is None:
            assert time.monotonic() < end
        with pytest.raises(processes.RunError, match='broken ended with status 1: no table'):
            nodes.check()
