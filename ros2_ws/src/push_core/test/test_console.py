"""The standard streams that a console script finds; each is a real process."""

import subprocess
import sys

import pytest

PROGRAM = """
import os, sys
from push_core.common.command_line import Parser, run_command
from push_core.console import console_script

class Module:
    main = staticmethod(lambda: run_command(Parser('Prints \\u2026'), work))

def work(arguments):
    with open({opened!r}, 'w') as file:
        assert file.fileno() > 2
    sys.stdout.write('\\u2026\\n')

sys.modules['module'] = Module
sys.exit(console_script('module')())
"""


@pytest.fixture
def script(tmp_path):
    def run(redirection='', *, encoding='utf-8', options=''):
        program = tmp_path / 'prints.py'
        program.write_text(PROGRAM.format(opened=str(tmp_path / 'opened')))
        return subprocess.run(
            ['sh', '-c', f'{sys.executable} {program} {options} {redirection}'],
            env={'PYTHONPATH': ':'.join(sys.path), 'PYTHONIOENCODING': encoding},
            capture_output=True,
            check=False,
        )

    return run


@pytest.mark.parametrize('encoding', ['ascii', 'latin-1', 'cp1252', 'utf-8'])
@pytest.mark.parametrize('options', ['', '--help'])
def test_any_terminal_shows_the_output(script, encoding, options) -> None:
    done = script(encoding=encoding, options=options)
    assert (done.returncode, done.stderr) == (0, b'')
    assert b'\\u2026' in done.stdout or '…' in done.stdout.decode(encoding)


def test_a_closed_output_is_one_line(script) -> None:
    done = script('>&-')
    assert done.returncode == 2
    assert done.stderr.decode() == (
        'prints.py: standard output is closed; add > /dev/null if it is not needed\n'
    )


@pytest.mark.parametrize('redirection', ['<&-', '2>&-', '<&- 2>&-'])
def test_other_streams_may_be_closed(script, redirection) -> None:
    done = script(redirection)
    assert (done.returncode, done.stdout.decode(), done.stderr) == (0, '…\n', b'')


def test_all_streams_closed_is_a_status_without_a_word(script) -> None:
    done = script('<&- >&- 2>&-')
    assert (done.returncode, done.stdout, done.stderr) == (2, b'', b'')


def test_a_full_disk_is_one_line(script) -> None:
    done = script('> /dev/full')
    assert (done.returncode, done.stderr) == (1, b'prints.py: No space left on device\n')
