"""A run of the node graph: four processes over DDS."""

import os
import time
from pathlib import Path

from push_node.ros_environment import check_ros_environment

from push_bringup.graph.cell_lock import CellLock
from push_bringup.graph.processes import Processes
from push_bringup.setup import installed_config

FAST_DDS_PROFILES = 'FASTRTPS_DEFAULT_PROFILES_FILE'
REST_TIME = 0.3  # [s] for watchdog, braking and the last messages


def run_graph(
    params: Path, namespace: str, logs: Path, *, watch: bool = False, lessons: int = 0
) -> str:
    """Starts the nodes, pushes once along the track, stops them cleanly.

    Args:
        params: resolved parameter file.
        namespace: of the nodes, '' for none.
        logs: folder for the output of the nodes.
        watch: whether to show a view of the cell in the terminal.
        lessons: laps that teach.

    Returns:
        Reason of an early end, else an empty string.

    Raises:
        InputError: the environment lacks what ROS needs.
        KeyboardInterrupt: a stop was requested.
    """
    check_ros_environment()
    with (
        CellLock(namespace),
        Processes(params, namespace, logs) as processes,
    ):
        os.environ.setdefault(FAST_DDS_PROFILES, str(installed_config('fastdds.xml')))
        # rclpy is slow to import, and other modes need none of it
        from push_bringup.graph.conductor import Conductor  # noqa: PLC0415

        conductor = Conductor(namespace, processes, watch=watch, lessons=lessons)
        try:
            return conductor.run()
        finally:
            _stop_in_order(processes)
            conductor.close()


def _stop_in_order(processes: Processes) -> None:
    """Stops the controller first and the recorder last, when the plant is at rest."""
    processes.interrupt('mpc_node', 'gp_server')
    time.sleep(REST_TIME)
    processes.stop('sim_node', 'mpc_node', 'gp_server')
    processes.stop('recorder')
