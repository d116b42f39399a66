"""What happens in the graph: a stop, a second commander, a second cell, a network that is cut."""

import random
import time

from geometry_msgs.msg import TwistStamped
from push_node import interface
from push_node.stamps import to_stamp

from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault, Outcome
from push_bringup.faults.injections import FOR_GOOD, WATCHDOG, Inject

GRAPH_LOOK = 0.7  # [s] from a second publisher to the stop
_FAR = ('mpc_node', 'gp_server', 'recorder')


def _asked_to_stop(bed: Bed, _random: random.Random) -> float:
    bed.call(interface.STOP)
    return 0.0


def _second_commander(bed: Bed, _random: random.Random) -> float:
    publisher = interface.PUSHER_VELOCITY_CMD.publisher(bed.node)
    message = TwistStamped()
    message.twist.linear.x = 0.2
    for _ in range(100):
        message.header.stamp = to_stamp(bed.now())
        publisher.publish(message)
        bed.spin(0.01)
    bed.node.destroy_publisher(publisher)
    return 1.0


def _second_cell(namespace: str, domain: int) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        begun = time.monotonic()
        with bed.neighbour(namespace, domain):
            bed.spin(4.0)
        return time.monotonic() - begun

    return inject


def _cut(duration: float) -> Inject:
    """The network between plant and controller is cut for a time [s]."""

    def inject(bed: Bed, _random: random.Random) -> float:
        bed.link.cut()
        bed.spin(duration)
        bed.link.join()
        return duration

    return inject


GRAPH_FAULTS: dict[str, Fault] = {
    'stop': Fault(
        f'the service {interface.STOP.name} is called',
        Outcome.STOPS,
        _asked_to_stop,
        'on request',
    ),
    'second_commander': Fault(
        'another node commands the tip with 0.2 m/s',
        Outcome.STOPS,
        _second_commander,
        'the tip as well',
        GRAPH_LOOK,
    ),
    'cell_in_namespace': Fault(
        'another cell starts and ends, in another namespace',
        Outcome.CONTINUES,
        _second_cell('_beside', 0),
    ),
    'cell_in_domain': Fault(
        'another cell of the same name starts and ends, in another ROS domain',
        Outcome.CONTINUES,
        _second_cell('', 1),
    ),
    'network_200ms': Fault(
        'the network between plant and controller is cut for 200 ms',
        Outcome.CONTINUES,
        _cut(0.2),
        far=_FAR,
    ),
    'network_3s': Fault(
        'the network between plant and controller is cut for 3 s',
        Outcome.STOPS,
        _cut(FOR_GOOD),
        'no pose for',
        WATCHDOG,
        far=_FAR,
    ),
}
