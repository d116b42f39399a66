"""The same four nodes with the same parameters, for `ros2 launch push_bringup cell.launch.py`."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

NODES = {
    'push_sim': 'sim_node',
    'push_gp': 'gp_server',
    'push_mpc': 'mpc_node',
    'push_bag': 'recorder',
}


def generate_launch_description() -> LaunchDescription:
    params = Path(get_package_share_directory('push_bringup')) / 'config' / 'cell.yaml'
    arguments = [
        DeclareLaunchArgument('params_file', default_value=str(params)),
        DeclareLaunchArgument('namespace', default_value=''),
        DeclareLaunchArgument('folder', default_value='run', description='new folder of the run'),
    ]
    nodes = [
        Node(
            package=package,
            executable=executable,
            namespace=LaunchConfiguration('namespace'),
            parameters=[LaunchConfiguration('params_file'), *_own(executable)],
            output='screen',
        )
        for package, executable in NODES.items()
    ]
    return LaunchDescription([*arguments, *nodes])


def _own(executable: str) -> list[dict[str, LaunchConfiguration]]:
    return [{'folder': LaunchConfiguration('folder')}] if executable == 'recorder' else []
