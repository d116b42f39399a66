"""What the launch file starts, without launch."""

from pathlib import Path

import pytest
import yaml
from push_bringup.commands.launch_arguments import ARGUMENTS, check_known
from push_bringup.commands.launched_cell import LaunchedCell, launched_cell
from push_bringup.setup.cell_parameters import installed_config
from push_core.common.errors import InputError
from push_core.tracks import TRACKS
from push_mpc.settings.controllers import CONTROLLERS
from push_node.interface import TOPICS
from push_sim.settings.profiles import PROFILES

DEFAULTS = {argument.name: argument.default for argument in ARGUMENTS}


@pytest.fixture
def launched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Launches the analytical controller on the line, in a folder of its own."""
    monkeypatch.chdir(tmp_path)

    def launch(**changes: str) -> LaunchedCell:
        return launched_cell({**DEFAULTS, 'track': 'line', 'controller': 'analytical', **changes})

    return launch


def parameters(cell: LaunchedCell) -> dict:
    (file,) = {node.params for node in cell.nodes if node.params}
    blocks = yaml.safe_load(file.read_text())
    return {name.removeprefix('/**/'): block['ros__parameters'] for name, block in blocks.items()}


def names(cell: LaunchedCell) -> list[str]:
    return [node.executable for node in cell.nodes]


def test_choices_are_those_of_the_registries() -> None:
    choices = {argument.name: argument.choices for argument in ARGUMENTS}
    assert choices['controller'] == tuple(CONTROLLERS)
    assert choices['profile'] == tuple(PROFILES)
    (track,) = (argument for argument in ARGUMENTS if argument.name == 'track')
    assert all(name in track.text for name in TRACKS)


def test_every_argument_is_described_and_its_default_a_choice() -> None:
    assert all(argument.text for argument in ARGUMENTS)
    assert all(not each.choices or each.default in each.choices for each in ARGUMENTS)


def test_an_unknown_argument_is_refused_with_the_known_ones() -> None:
    check_known(['track:=square', 'laps:=2'])
    with pytest.raises(InputError, match="unknown argument 'trak'; known: track, speed"):
        check_known(['trak:=square'])


def test_the_arguments_reach_the_nodes(launched) -> None:
    cell = launched(track='square', speed='0.05', laps='2', seed='7', profile='harsh')
    values = parameters(cell)
    assert names(cell) == ['sim_node', 'gp_server', 'mpc_node', 'recorder']
    assert {key: values['mpc_node'][key] for key in ('track', 'speed', 'laps')} == {
        'track': 'square',
        'speed': 0.05,
        'laps': 2,
    }
    assert (values['sim_node']['seed'], values['sim_node']['profile']) == (7, 'harsh')
    attached = [Path(name).name for name in values['recorder']['attachments'].splitlines()]
    assert attached == ['params.yaml', 'nominal_trajectory.csv']


def test_two_launches_in_the_same_second_have_folders_of_their_own(launched) -> None:
    folders = {launched().folder for _ in range(3)}
    assert len(folders) == 3
    assert not any(folder.exists() for folder in folders)


def test_without_a_recorder_the_controller_waits_for_none(launched) -> None:
    cell = launched(record='false')
    assert 'recorder' not in names(cell)
    assert cell.folder is None
    assert parameters(cell)['mpc_node']['require_recorder'] is False


def test_what_only_helps_may_end_without_the_cell(launched) -> None:
    cell = launched(rviz='true', autostart='true')
    assert [each.executable for each in cell.nodes if not each.is_vital] == [
        'markers',
        'rviz2',
        'start',
    ]


def test_a_namespace_has_a_simulated_time_of_its_own(launched) -> None:
    assert launched(namespace='/left/').remappings == [('/clock', 'clock')]
    assert launched().remappings == []


@pytest.mark.parametrize(
    ('changes', 'message'),
    [
        ({'track': 'triangle'}, "unknown track 'triangle'"),
        ({'speed': 'fast'}, "speed is 'fast', must be a number"),
        ({'laps': '1.5'}, "laps is '1.5', must be a whole number"),
        ({'speed': '-1'}, 'must be above 0 m/s'),
        ({'namespace': 'a b'}, 'takes letters, digits'),
        ({'folder': '.'}, 'folder . exists'),
    ],
)
def test_what_cannot_run_is_refused_before_anything_starts(launched, changes, message) -> None:
    with pytest.raises(InputError, match=message):
        launched(**changes)


def test_rviz_shows_topics_of_the_cell() -> None:
    layout = yaml.safe_load(installed_config('cell.rviz').read_text())
    arrays = {
        display['Topic']['Value']
        for display in layout['Visualization Manager']['Displays']
        if display['Class'] == 'rviz_default_plugins/MarkerArray'
    }
    assert arrays == {topic.name for topic in TOPICS if topic.type_name.endswith('/MarkerArray')}


def test_a_parameter_file_counts_where_an_argument_has_its_default(launched, tmp_path) -> None:
    mine = tmp_path / 'mine.yaml'
    mine.write_text('/**:\n  ros__parameters: {speed: 5e-2, seed: 9, profile: ideal}\n')
    own = parameters(launched(params_file=str(mine), seed='3'))
    assert (own['mpc_node']['speed'], own['sim_node']['seed']) == (0.05, 3)
    assert own['sim_node']['profile'] == own['mpc_node']['profile'] == 'ideal'
