"""Synthetic runs with known errors, recorded as real ones are."""

import itertools
import math
from dataclasses import dataclass, field
from pathlib import Path
from statistics import NormalDist

import numpy as np
import pytest
from mcap.writer import Writer
from push_bag.file.bag_writer import BagWriter
from push_bag.file.message_types import message_class
from push_bag.file.qos_text import qos_text
from push_msgs.msg import ControllerState
from push_node.interface import LESSON, TOPICS
from rclpy.serialization import serialize_message
from std_msgs.msg import String

SIDE, TIP = 0.09, 0.00475
PERIOD_NS = 10_000_000
STAMP_0 = 1_000_000_000_000
WALL_0 = 1_700_000_000_000_000_000
ARMED_TICKS = 20
LEAD_TICKS = 11  # in TRACKING before the reference starts
DONE_TICKS = 10
LEAD = 0.12  # [s] from an exposure to the instant that is predicted
TRUTH = 'push_sim/ground_truth'
FLUSH_TICKS = 25  # as the recorder does every 0.25 s
EXTRA = ('perturbation', 'horizon', 'run_end', TRUTH)
HORIZON = np.linspace(0.0, 0.35, 36)  # [s] ahead
CORE = {topic.name: topic for topic in TOPICS if topic.core or topic.name in EXTRA}


def on_circle(time):
    """A lap round a circle of 150 mm at 80 mm/s: pose (3,) at a time [s]."""
    turn = 0.08 / 0.15 * time
    return np.array([0.15 * math.sin(turn), 0.15 * (1.0 - math.cos(turn)), turn])


def on_line(time):
    """A straight line along x at 80 mm/s."""
    return np.array([0.08 * time, 0.0, 0.0])


@dataclass
class Synthetic:
    """How a synthetic run differs from a perfect one."""

    path: object = on_circle
    duration: float = 1.5
    laps: int = 1
    displaced: object = lambda pose, time: pose
    truth: object = None  # true pose (3,), of the displaced pose and the time
    gap: object = lambda time: 0.0
    command_delay_ns: object = lambda tick: 1_500_000
    unanswered: tuple = ()
    missing: dict = field(default_factory=dict)  # topic -> ticks never received
    numbered: bool = True
    limited: object = lambda tick: 0
    modes: object = None
    foreign: object = lambda tick: ()  # commands of another: stamp [ns] after the pose, v_x
    perturbed_at: float | None = None
    predicted: object = lambda pose: pose  # of the pose that comes
    stop_reason: str = ''  # that the controller states at the end
    lessons: tuple = ()  # reference time from which it drives, pushes, friction, shift [m]
    end_reason: str = ''  # that the cell states
    facts: dict = field(default_factory=dict)

    def __post_init__(self):
        self.reference_ticks = round(self.duration * 100)
        self.ticks = ARMED_TICKS + LEAD_TICKS + self.reference_ticks + DONE_TICKS

    def mode(self, tick):
        if self.modes is not None:
            return self.modes(tick)
        if tick < ARMED_TICKS:
            return ControllerState.ARMED
        last = ARMED_TICKS + LEAD_TICKS + self.reference_ticks
        return ControllerState.TRACKING if tick <= last else ControllerState.DONE

    def reference_time(self, tick):
        return (tick - ARMED_TICKS - LEAD_TICKS) / 100


class Recorder:
    """Writes the messages of a synthetic run."""

    def __init__(self, folder, synthetic):
        facts = {'profile': 'irb120', 'seed': '7', 'mode': 'realtime'}
        self.bag = BagWriter(folder, facts | synthetic.facts, {'params.yaml': b'a: 1\n'})
        self.synthetic = synthetic
        self.sequences = dict.fromkeys(CORE, 0)
        # of a further start: ticks since the first one
        self.waited = self.stamp_shift = self.counted = 0
        for topic in CORE.values():
            if topic.name == TRUTH and synthetic.truth is None:
                continue
            self.bag.add_topic(f'/{topic.name}', topic.type_name, qos_text(topic.qos))
        if synthetic.lessons:
            self.bag.add_topic(f'/{LESSON.name}', LESSON.type_name, qos_text(LESSON.qos))

    def message(self, name, tick):
        message = message_class(CORE[name].type_name)()
        stamp = STAMP_0 + (tick + self.stamp_shift) * PERIOD_NS
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 1_000_000_000)
        message.header.frame_id = 'world'
        return message

    def write(self, name, tick, message, delay_ns=0):
        self.sequences[name] += 1
        if tick in self.synthetic.missing.get(name, ()):
            return
        sent = WALL_0 + (tick + self.waited) * PERIOD_NS + delay_ns
        number = self.sequences[name] if self.synthetic.numbered else 0
        self.bag.write(f'/{name}', serialize_message(message), sent + 100_000, sent, number)

    def record(self, *further):
        """Writes the run, then further ones, each with the shifts (waited, stamp, count)."""
        with self.bag:
            self.record_start()
            for synthetic, shifts in further:
                self.synthetic = synthetic
                self.waited, self.stamp_shift, self.counted = shifts
                self.record_start()
            end = String(data=self.synthetic.end_reason)
            self.write('run_end', self.synthetic.ticks - 1, end)

    def record_start(self):
        self.write('nominal_trajectory', 0, self.reference())
        self.write('model_info', 0, self.model())
        for number in range(len(self.synthetic.lessons)):
            self.bag.write(
                f'/{LESSON.name}', serialize_message(self.lesson(number)), WALL_0, WALL_0, 0
            )
        for tick in range(self.synthetic.ticks):
            self.record_tick(tick)

    def record_tick(self, tick):
        synthetic = self.synthetic
        time = synthetic.reference_time(tick)
        inside = min(max(time, 0.0), synthetic.duration)
        pose = synthetic.displaced(synthetic.path(inside), inside)
        self.write('object_pose', tick, self.posed(tick, 'object_pose', pose))
        self.write('pusher_pose', tick, self.posed(tick, 'pusher_pose', self.tip(pose, time)))
        if synthetic.truth is not None:
            truth = self.message(TRUTH, tick)
            truth.pose = synthetic.truth(pose, inside)
            self.write(TRUTH, tick, truth)
        if tick not in synthetic.unanswered:
            delay = synthetic.command_delay_ns(tick)
            command = self.message('pusher_velocity_cmd', tick)
            self.write('pusher_velocity_cmd', tick, command, delay)
            for stamp_ns, velocity in synthetic.foreign(tick):
                other = self.message('pusher_velocity_cmd', tick)
                other.header.stamp.nanosec += stamp_ns
                other.twist.linear.x = velocity
                self.write('pusher_velocity_cmd', tick, other, delay + 100_000)
        self.write('controller_state', tick, self.state(tick, time), 2_000_000)
        if tick % 5 == 0:
            self.write('horizon', tick, self.horizon(tick, time), 2_100_000)
        if tick % FLUSH_TICKS == 0:
            self.bag.flush()
        if synthetic.perturbed_at is not None and abs(time - synthetic.perturbed_at) < 1e-6:
            kick = self.message('perturbation', tick)
            kick.magnitude = 0.03
            self.write('perturbation', tick, kick)

    def posed(self, tick, name, pose):
        message = self.message(name, tick)
        message.pose.position.x, message.pose.position.y = float(pose[0]), float(pose[1])
        message.pose.orientation.z = math.sin(pose[2] / 2)
        message.pose.orientation.w = math.cos(pose[2] / 2)
        return message

    def tip(self, pose, time):
        x = -SIDE / 2 - TIP - self.synthetic.gap(time)
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        return np.array([pose[0] + cos * x, pose[1] + sin * x, 0.0])

    def state(self, tick, time):
        state = self.message('controller_state', tick)
        state.tick, state.mode = tick + self.counted, self.synthetic.mode(tick)
        state.reference_time = time
        driven = [n for n, lesson in enumerate(self.synthetic.lessons) if time >= lesson[0]]
        state.model_id = f'lesson {driven[-1]}' if driven else ''
        state.input = state.nominal_input = [0.08, 0.0]
        then = min(max(time + LEAD, 0.0), self.synthetic.duration)
        planned = self.synthetic.path(then)
        state.reference = [*planned, 0.0]
        state.predicted = [*self.synthetic.predicted(self.synthetic.displaced(planned, then)), 0.0]
        state.disturbance = [0.01, -0.02, 0.3]
        # normal, in an order of its own; the heading twice as far off as it is stated to be
        deviations = NormalDist().inv_cdf((37 * tick % 100 + 0.5) / 100)
        state.innovation_deviation = [2e-5, 3e-5, 1e-4]
        state.innovation = [2e-5 * deviations, -3e-5 * deviations, 2e-4 * deviations]
        state.solve_ms, state.tick_ms, state.iterations = 0.25 + tick % 7 * 0.01, 1.0, 10
        state.solver_status, state.limited = 1, self.synthetic.limited(tick)
        if tick == self.synthetic.ticks - 1:
            state.stop_reason = self.synthetic.stop_reason
        return state

    def lesson(self, number):
        _, pushes, friction, shift = self.synthetic.lessons[number]
        lesson = LESSON.message_class(lesson_id=f'lesson {number}', pushes=pushes)
        lesson.friction, lesson.support_radius = friction, 0.03
        lesson.covariance = [0.01, 0.0, 0.0, 0.0004]
        lesson.shift = [shift] * (2 * self.synthetic.reference_ticks // self.synthetic.laps)
        return lesson

    def horizon(self, tick, time):
        horizon = self.message('horizon', tick)
        path = np.array([self.synthetic.path(max(time, 0.0) + ahead) for ahead in HORIZON])
        horizon.step = 0.01
        horizon.x, horizon.y, horizon.theta = (column.copy() for column in path.T)
        return horizon

    def reference(self):
        plan = self.message('nominal_trajectory', 0)
        plan.track, plan.controller, plan.speed = 'eight', 'gp', 0.08
        plan.side, plan.tip_radius, plan.laps = SIDE, TIP, self.synthetic.laps
        times = np.arange(self.synthetic.reference_ticks + 1) / 100
        poses = np.array([self.synthetic.path(time) for time in times])
        plan.time, plan.x, plan.y, plan.theta = times, *(column.copy() for column in poses.T)
        plan.p_y = plan.v_t = np.zeros(times.size)
        plan.v_n = np.full(times.size, 0.08)
        return plan

    def model(self):
        info = self.message('model_info', 0)
        info.points, info.model_hash, info.kind = 200, 'abc123' * 8, 'gp'
        return info


def recording_in(parent):
    """Records synthetic runs in a folder: `record(duration=1.5, …)` gives the run's own."""
    numbers = itertools.count(1)

    def record_run(**changes) -> Path:
        folder = parent / f'run_{next(numbers)}'
        Recorder(folder, Synthetic(**changes)).record()
        return folder

    return record_run


@pytest.fixture
def record_starts(tmp_path):
    """Records several starts in one bag: `record_starts(changes, (changes, shifts), …)`."""

    def record_bag(first, *further) -> Path:
        others = [(Synthetic(**changes), shifts) for changes, shifts in further]
        Recorder(tmp_path / 'starts', Synthetic(**first)).record(*others)
        return tmp_path / 'starts'

    return record_bag


@pytest.fixture
def record(tmp_path):
    """Records runs for one test."""
    return recording_in(tmp_path)


@pytest.fixture(scope='module')
def record_once(tmp_path_factory):
    """Records runs that all tests of a module read."""
    return recording_in(tmp_path_factory.mktemp('runs'))


@pytest.fixture
def paths():
    """The reference paths that a synthetic run can follow."""
    return {'line': on_line, 'circle': on_circle}


@pytest.fixture(scope='session')
def perfect(tmp_path_factory):
    """The folder of a run without errors; tests only read it."""
    folder = tmp_path_factory.mktemp('runs') / 'perfect'
    Recorder(folder, Synthetic()).record()
    return folder


CDR_TEXT = b'\0\1\0\0\2\0\0\0a\0'
STRING = ('std_msgs/msg/String', 'ros2msg', b'string data\n')


class Bag:
    """An MCAP file that is being written with the library of the format's makers."""

    def __init__(self, path, profile='', **options):
        self.path = path
        self.stream = path.open('wb')
        self.writer = Writer(self.stream, **options)
        self.writer.start(profile=profile)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.writer.finish()
        self.stream.close()

    def channel(self, topic='/chatter', schema=STRING, encoding='cdr', **metadata):
        number = self.writer.register_schema(*schema) if schema else 0
        return self.writer.register_channel(topic, encoding, number, metadata)

    def add(self, channel, log_ns=10, data=CDR_TEXT, sequence=0, publish_ns=9):
        self.writer.add_message(channel, log_ns, data, publish_ns, sequence)


@pytest.fixture
def bag(tmp_path):
    """Opens a new MCAP file for writing."""

    def write(name='other.mcap', **options):
        return Bag(tmp_path / name, **options)

    return write
