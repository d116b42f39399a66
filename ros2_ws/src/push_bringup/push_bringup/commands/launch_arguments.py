"""The arguments of `ros2 launch push_bringup cell.launch.py`; needs no launch itself."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from push_core.common import InputError
from push_core.tracks import TRACKS
from push_mpc.settings import CONTROLLERS, PRESETS
from push_sim.settings import PROFILES

_BOOLEAN = ('true', 'false')


@dataclass(frozen=True)
class LaunchArgument:
    """One argument, `name:=value`.

    Attributes:
        name: of the argument.
        text: one phrase that describes it.
        default: value if it is not given.
        choices: allowed values; empty if it is not a choice.
    """

    name: str
    text: str
    default: str
    choices: tuple[str, ...] = ()


ARGUMENTS = (
    LaunchArgument('track', f'{", ".join(TRACKS)} or a .csv file of x, y [m]', 'eight'),
    LaunchArgument('speed', "of the object's centre [m/s]", '0.08'),
    LaunchArgument('controller', 'of the pusher', 'gp', tuple(CONTROLLERS)),
    LaunchArgument('model', 'model file for gp; empty: 200 simulated pushes', ''),
    LaunchArgument('profile', 'robot and cameras', 'irb120', tuple(PROFILES)),
    LaunchArgument('preset', 'defaults of the controller', 'tuned', PRESETS),
    LaunchArgument(
        'mode',
        'realtime: by the wall clock; lockstep: nodes in step, repeatable',
        'realtime',
        ('realtime', 'lockstep'),
    ),
    LaunchArgument(
        'start',
        'plan: at the start of the track; here: the track is moved to where the object lies',
        'plan',
        ('plan', 'here'),
    ),
    LaunchArgument('laps', 'rounds of a closed track', '1'),
    LaunchArgument('learn', 'let each lap teach the next', 'false', _BOOLEAN),
    LaunchArgument('seed', 'of everything random', '0'),
    LaunchArgument(
        'autostart',
        'put the object where the plan starts, if it is not there, and start',
        'false',
        _BOOLEAN,
    ),
    LaunchArgument('record', 'record a bag', 'true', _BOOLEAN),
    LaunchArgument('folder', 'new folder of the bag; empty: named by time, in runs/', ''),
    LaunchArgument('rviz', 'show the cell in RViz', 'false', _BOOLEAN),
    LaunchArgument('namespace', 'of the nodes', ''),
    LaunchArgument('params_file', 'ROS parameter file that overrides the defaults', ''),
)


DEFAULTS = {argument.name: argument.default for argument in ARGUMENTS}


def check_known(given: Iterable[str]) -> None:
    """Checks the words of a command line.

    Args:
        given: `name:=value` each.

    Raises:
        InputError: names the first unknown argument, and the known ones.
    """
    known = [argument.name for argument in ARGUMENTS]
    for word in given:
        name = word.partition(':=')[0]
        if name not in known:
            raise InputError(f'unknown argument {name!r}; known: {", ".join(known)}')


def number(values: Mapping[str, str], name: str, kind: type[int] | type[float]) -> float | None:
    """The value of an argument as a number; None if it is not given.

    Raises:
        InputError: it is none.
    """
    if name not in values:
        return None
    try:
        return kind(values[name])
    except ValueError:
        article = 'a whole number' if kind is int else 'a number'
        raise InputError(f'{name} is {values[name]!r}, must be {article}') from None
