import subprocess
import sys

import pytest
from push_core.common.command_line import Parser, describe, run_command
from push_core.common.errors import InputError, PushError, RunError

FLOOD = """
import sys
from push_core.common.command_line import Parser, run_command

def flood(arguments):
    while True:
        sys.stdout.write('water\\n')

sys.exit(run_command(Parser('floods'), flood, []))
"""


def raising(error):
    def work(_arguments):
        raise error

    return work


@pytest.fixture
def parser() -> Parser:
    parser = Parser('Does a job.')
    parser.prog = 'job'
    parser.add_argument('--times', type=int, default=1)
    return parser


@pytest.mark.parametrize(('answer', 'status'), [(None, 0), (0, 0), (1, 1), (7, 7)])
def test_the_status_is_what_the_work_returns(parser, answer, status) -> None:
    assert run_command(parser, lambda _arguments: answer, []) == status


def test_the_work_sees_its_arguments(parser) -> None:
    assert run_command(parser, lambda arguments: arguments.times, ['--times', '3']) == 3


@pytest.mark.parametrize(
    ('error', 'status', 'line'),
    [
        (InputError('no such track'), 2, 'job: no such track'),
        (RunError('the plant\nstopped'), 1, 'job: the plant stopped'),
        (PushError('something'), 1, 'job: something'),
        (FileNotFoundError(2, 'No such file', 'a.csv'), 1, 'job: a.csv: No such file'),
        (OSError(28, 'No space left on device'), 1, 'job: No space left on device'),
        (KeyboardInterrupt(), 130, 'job: interrupted'),
    ],
)
def test_an_error_is_one_line_and_a_status(parser, capsys, error, status, line) -> None:
    assert run_command(parser, raising(error), []) == status
    output = capsys.readouterr()
    assert output.err == line + '\n'
    assert output.out == ''


def test_debug_adds_the_traceback_before_the_line(parser, capsys) -> None:
    assert run_command(parser, raising(InputError('no such track')), ['--debug']) == 2
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].startswith('Traceback')
    assert lines[-1] == 'job: no such track'


@pytest.mark.parametrize('arguments', [['--none'], ['--times', 'many'], ['spare']])
def test_wrong_arguments_are_one_line_of_status_2(parser, capsys, arguments) -> None:
    with pytest.raises(SystemExit) as caught:
        run_command(parser, lambda _arguments: 0, arguments)
    assert caught.value.code == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert lines[0].startswith('job: ')
    assert lines[0].endswith('; see job --help')


def test_a_mistake_of_the_program_is_not_hidden(parser) -> None:
    with pytest.raises(ZeroDivisionError):
        run_command(parser, raising(ZeroDivisionError()), [])


def test_a_reader_that_goes_away_ends_the_command_in_silence() -> None:
    command = subprocess.Popen(
        [sys.executable, '-c', FLOOD], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert command.stdout is not None
    assert command.stderr is not None
    command.stdout.readline()
    command.stdout.close()
    assert command.stderr.read() == b''
    assert command.wait(timeout=60.0) == 141
    command.stderr.close()


def test_an_error_without_words_of_its_own_is_described_all_the_same() -> None:
    assert describe(OSError('broken')) == 'broken'
