"""All kinds of faults."""

import math
import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable

from geometry_msgs.msg import Pose, PoseStamped, TwistStamped
from push_mpc.settings import MpcSettings
from push_msgs.srv import AddPushes
from push_node import interface
from push_node.endpoints import GraphTopic
from push_node.stamps import to_nanoseconds, to_stamp

from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault, Outcome
from push_bringup.faults.relay import Spoil
from push_bringup.graph import MODULES

POSE_TIMEOUT = MpcSettings().pose_timeout
WATCHDOG = 0.05  # [s], parameter command_timeout
RECORDER_SILENCE = 2.6  # [s] from the end of the recorder to the stop
GRAPH_LOOK = 0.7  # [s] from a second publisher to the stop
FROZEN = 0.27  # [s], parameter guard.frozen and one tick
FAST = 0.06  # [s] longer to rest from the largest speed: the lag is exponential
OVERLAPS = 0.35  # [s] until the tip seems to be guard.overlap inside the object
FOR_GOOD = 3.0  # [s]
PUSH = 0.004  # [m], parameter distance of gp_server
POISONED = 10.0  # [s] in which a wrong model loses the object
BOTH = ('realtime', 'lockstep')
Inject = Callable[[Bed, random.Random], float]


def _signal(name: str, number: int) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        bed.signal(name, number)
        return 0.0

    return inject


def _freeze(names: tuple[str, ...], duration: float) -> Inject:
    """SIGSTOP for a time [s]."""

    def inject(bed: Bed, _random: random.Random) -> float:
        for name in names:
            bed.signal(name, signal.SIGSTOP)
        bed.spin(duration)
        for name in names:
            bed.signal(name, signal.SIGCONT)
        return duration

    return inject


def _spoil(spoil: Spoil, duration: float) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        bed.relay.spoil = spoil
        begun = bed.now()
        bed.wait(lambda: bed.ended or bed.now() - begun > 1e9 * duration, 20.0)
        bed.relay.spoil = None
        return duration

    return inject


def _lost(_message: PoseStamped, _topic: str) -> bool:
    return False


def _not_a_number(message: PoseStamped, _topic: str) -> bool:
    message.pose.position.x = math.nan
    return True


def _wrong_frame(message: PoseStamped, _topic: str) -> bool:
    message.header.frame_id = 'camera'
    return True


def _no_rotation(message: PoseStamped, _topic: str) -> bool:
    message.pose.orientation.w = 0.0
    return True


def _tilted(message: PoseStamped, topic: str) -> bool:
    if topic == interface.OBJECT_POSE.short_name:
        message.pose.orientation.x = math.sin(0.25)
        message.pose.orientation.w *= math.cos(0.25)
        message.pose.orientation.z *= math.cos(0.25)
    return True


def _frozen(*topics: GraphTopic) -> Inject:
    """The poses of topics repeat, with new stamps."""

    def inject(bed: Bed, chance: random.Random) -> float:
        first: dict[str, Pose] = {}

        def repeat(message: PoseStamped, topic: str) -> bool:
            if topic in names:
                message.pose = first.setdefault(topic, message.pose)
            return True

        return _spoil(repeat, FOR_GOOD)(bed, chance)

    names = {topic.short_name for topic in topics}
    return inject


def _jumping(message: PoseStamped, topic: str) -> bool:
    """One pose of the object in nine is 0.3 m away."""
    if topic == interface.OBJECT_POSE.short_name and message.header.stamp.nanosec % 9 == 0:
        message.pose.position.y += 0.3
    return True


def _shifted(seconds: float) -> Spoil:
    def spoil(message: PoseStamped, _topic: str) -> bool:
        stamp = to_nanoseconds(message.header.stamp) + round(1e9 * seconds)
        message.header.stamp = to_stamp(max(stamp, 0))
        return True

    return spoil


def _sick(how: str, duration: float) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        bed.make_sick(how)
        begun = bed.now()
        bed.wait(lambda: bed.ended or bed.now() - begun > 1e9 * duration, 20.0)
        bed.make_sick('')
        return duration

    return inject


def _wait(duration: float) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        bed.spin(duration)
        return duration

    return inject


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


def _full_disk(bed: Bed, _random: random.Random) -> float:
    """Writes of the recorder fail from here on, as on a full disk."""
    size = max(path.stat().st_size for path in bed.folder.glob('*.mcap'))
    limit = (size, resource.getrlimit(resource.RLIMIT_FSIZE)[1])
    resource.prlimit(bed.processes.pid('recorder'), resource.RLIMIT_FSIZE, limit)
    return 0.0


def _hogged(bed: Bed, _random: random.Random) -> float:
    hogs = [
        subprocess.Popen([sys.executable, '-c', 'while True: pass'])
        for _ in range(2 * (os.cpu_count() or 1))
    ]
    bed.spin(2.0)
    for hog in hogs:
        hog.kill()
        hog.wait()
    return 2.0


def _asked_to_stop(bed: Bed, _random: random.Random) -> float:
    bed.call(interface.STOP)
    return 0.0


def _second_cell(namespace: str, domain: int) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        begun = time.monotonic()
        with bed.neighbour(namespace, domain):
            bed.spin(4.0)
        return time.monotonic() - begun

    return inject


def _kills() -> dict[str, Fault]:
    gone = 'was killed by signal 9'
    unrecorded = {'require_recorder': False}
    outcomes = {
        'sim_node': (Outcome.STOPS, 'no pose for', 0.0),
        'gp_server': (Outcome.CONTINUES, gone, 0.0),
        'mpc_node': (Outcome.RESTS, gone, WATCHDOG),
        'recorder': (Outcome.STOPS, 'no report from the recorder', RECORDER_SILENCE),
    }
    faults = {
        f'kill_{name}': Fault(
            f'{name} is killed',
            outcome,
            _signal(name, signal.SIGKILL),
            reason,
            detection,
            breaks=True,
            unrecorded=name == 'recorder',
        )
        for name, (outcome, reason, detection) in outcomes.items()
    }
    faults['kill_recorder_unrequired'] = Fault(
        'the recorder is killed, and none is required',
        Outcome.CONTINUES,
        _signal('recorder', signal.SIGKILL),
        gone,
        parameters=unrecorded,
        breaks=True,
    )
    return faults


def _freezes() -> dict[str, Fault]:
    faults = {
        f'freeze_{name}': Fault(
            f'{name} does not run for 200 ms', Outcome.CONTINUES, _freeze((name,), 0.2)
        )
        for name in MODULES
    }
    everything = tuple(MODULES)
    faults['freeze_all'] = Fault(
        'no node runs for 1 s', Outcome.CONTINUES, _freeze(everything, 1.0)
    )
    faults['halt_mpc_node'] = Fault(
        'mpc_node does not run for 3 s',
        Outcome.RESTS,
        _signal('mpc_node', signal.SIGSTOP),
        detection=WATCHDOG,
        breaks=True,
    )
    faults['halt_recorder'] = Fault(
        'the recorder does not run any more',
        Outcome.STOPS,
        _signal('recorder', signal.SIGSTOP),
        'no report from the recorder',
        RECORDER_SILENCE,
        breaks=True,
        unrecorded=True,
    )
    return faults


def _pose_faults() -> dict[str, Fault]:
    goes_on = {
        f'dropout_{round(1e3 * duration)}ms': Fault(
            f'no pose for {round(1e3 * duration)} ms',
            Outcome.CONTINUES,
            _spoil(_lost, duration),
        )
        for duration in (0.02, 0.05, 0.2)
    }
    stops = {
        'dropout_2s': (_lost, 'no pose for 2 s', 'no pose for'),
        'pose_nan': (_not_a_number, 'x is NaN', 'not finite'),
        'pose_frame': (_wrong_frame, 'the frame of the poses changes', "frame is 'camera'"),
        'pose_quaternion': (_no_rotation, 'the quaternion is no rotation', 'quaternion'),
        'pose_tilted': (_tilted, 'the object is tilted', 'tilted'),
        'clock_back_1s': (_shifted(-1.0), 'the clock of the cameras steps back 1 s', 'old'),
        'clock_ahead_1s': (_shifted(1.0), 'the clock of the cameras steps ahead 1 s', 'future'),
    }
    repeated = {
        'pose_frozen': Fault(
            'the cameras repeat one picture',
            Outcome.STOPS,
            _frozen(interface.OBJECT_POSE, interface.PUSHER_POSE),
            'have not changed',
            FROZEN + FAST,
        ),
        'pose_frozen_object': Fault(
            'one camera repeats the pose of the object',
            Outcome.STOPS,
            _frozen(interface.OBJECT_POSE),
            'inside the object',
            FROZEN + OVERLAPS + FAST,
        ),
        'pose_jumping': Fault(
            'one pose of the object in nine is 0.3 m away',
            Outcome.CONTINUES,
            _spoil(_jumping, 2.0),
        ),
    }
    return (
        goes_on
        | repeated
        | {
            kind: Fault(text, Outcome.STOPS, _spoil(spoil, FOR_GOOD), reason, POSE_TIMEOUT)
            for kind, (spoil, text, reason) in stops.items()
        }
    )


def _solver_faults() -> dict[str, Fault]:
    sick = ('mpc_node',)
    failing = {
        how: Fault(
            f'every QP: the solver {text}',
            Outcome.STOPS,
            _sick(how, FOR_GOOD),
            'solver',
            modes=BOTH,
            sick=sick,
        )
        for how, text in {
            'infeasible': 'says that it is infeasible',
            'unfinished': 'stops at its iteration limit without an input',
            'raises': 'raises an exception',
        }.items()
    }
    slow = Fault('every QP takes 20 ms', Outcome.CONTINUES, _sick('slow', 2.0), sick=sick)
    return {f'solver_{how}': fault for how, fault in failing.items()} | {'solver_slow': slow}


def _learn(how: str, duration: float = 2.0) -> Inject:
    """The server is sick while a model that has grown is announced."""

    def inject(bed: Bed, chance: random.Random) -> float:
        bed.make_sick(how)
        p_y, beta = chance.uniform(-0.04, 0.04), chance.uniform(0.5, 2.5)
        request = AddPushes.Request(p_y=[p_y], beta=[beta], distance=PUSH)
        request.displacement = [0.003, 0.0, 0.0]
        client = interface.ADD_PUSHES.client(bed.node)
        bed.wait(client.service_is_ready, 5.0)
        client.call_async(request)
        bed.wait(lambda: bed.ended, duration)
        bed.make_sick('')
        return duration

    return inject


def _server_faults() -> dict[str, Fault]:
    sick = ('gp_server',)
    return {
        f'server_{how}': Fault(
            f'a model that has grown is announced, and the server {text}',
            Outcome.CONTINUES,
            _learn(how),
            sick=sick,
        )
        for how, text in {
            'silent': 'does not answer',
            'late': 'answers each request 0.3 s late',
            'nonsense': 'answers NaN',
            'huge': 'answers 1e300',
            'short': 'answers half of each request',
        }.items()
    } | {
        'server_poison': Fault(
            'a model that has grown is announced, with left and right exchanged',
            Outcome.RESTS,
            _learn('poison', POISONED),
            '',
            POISONED,
            sick=sick,
            breaks=True,
        )
    }


def _others() -> dict[str, Fault]:
    return {
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
        'disk_full': Fault(
            'the disk of the recording is full',
            Outcome.STOPS,
            _full_disk,
            'the recorder does not record',
            RECORDER_SILENCE,
            breaks=True,
            unrecorded=True,
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
        'cores_hogged': Fault('two processes on each core for 2 s', Outcome.CONTINUES, _hogged),
        'commands_lost': Fault(
            'one command in ten is lost',
            Outcome.CONTINUES,
            _wait(2.0),
            modes=BOTH,
            parameters={'command_loss': 0.1},
        ),
    }


KINDS: dict[str, Fault] = {
    **_kills(),
    **_freezes(),
    **_pose_faults(),
    **_solver_faults(),
    **_server_faults(),
    **_others(),
}
"""Every fault by its name."""
