"""The nodes of a cell: `ros2 launch push_bringup cell.launch.py track:=square autostart:=true`.

`--show-args` lists the arguments. The cell ends when one of its nodes ends, and on Ctrl-C.
"""

import sys
from collections.abc import Callable
from pathlib import Path

from launch import LaunchContext, LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    LogInfo,
    OpaqueFunction,
    SetEnvironmentVariable,
    Shutdown,
)
from launch.events.process import ProcessExited
from launch.substitutions import EnvironmentVariable
from launch_ros.actions import Node
from push_bringup.commands.launch_arguments import ARGUMENTS, LaunchArgument, check_known
from push_bringup.commands.launched_cell import LaunchedCell, LaunchedNode, launched_cell
from push_bringup.graph.node_graph import FAST_DDS_PROFILES
from push_bringup.setup import installed_config
from push_node.spin import LAUNCHED

# each node ends within this time after Ctrl-C, even one that still imports on a busy machine
PATIENCE = '60'  # [s]


def generate_launch_description() -> LaunchDescription:
    profiles = str(installed_config('fastdds.xml'))
    return LaunchDescription(
        [
            *(_declared(argument) for argument in ARGUMENTS),
            SetEnvironmentVariable(
                FAST_DDS_PROFILES,
                EnvironmentVariable(FAST_DDS_PROFILES, default_value=profiles),
            ),
            OpaqueFunction(function=_started),
        ]
    )


def _declared(argument: LaunchArgument) -> DeclareLaunchArgument:
    return DeclareLaunchArgument(
        argument.name,
        default_value=argument.default,
        description=argument.text,
        choices=argument.choices or None,
    )


def _started(context: LaunchContext) -> list[Node | LogInfo]:
    # included in another file, the command line has that one's arguments
    if Path(__file__).name in {Path(word).name for word in sys.argv}:
        check_known(context.argv)
    names = [argument.name for argument in ARGUMENTS]
    cell = launched_cell({name: context.launch_configurations[name] for name in names})
    place = f'the bag is {cell.folder}' if cell.folder else 'nothing is recorded'
    return [LogInfo(msg=place), *(_node(each, cell) for each in cell.nodes)]


def _node(each: LaunchedNode, cell: LaunchedCell) -> Node:
    return Node(
        package=each.package,
        executable=each.executable,
        namespace=cell.namespace,
        arguments=list(each.arguments),
        parameters=[str(each.params)] if each.params else None,
        remappings=cell.remappings,
        output='screen',
        additional_env={LAUNCHED: '1'},
        sigterm_timeout=PATIENCE,
        on_exit=_on_exit(each),
    )


def _on_exit(each: LaunchedNode) -> Callable[[ProcessExited, LaunchContext], Shutdown | None]:
    def on_exit(event: ProcessExited, _context: LaunchContext) -> Shutdown | None:
        if not each.is_vital and event.returncode == 0:
            return None
        return Shutdown(reason=f'{each.executable} ended with status {event.returncode}')

    return on_exit
