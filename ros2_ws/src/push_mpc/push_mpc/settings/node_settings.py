"""Parameters of mpc_node: those of the controller, the track, and the node's own."""

from dataclasses import dataclass, replace

from push_core.common import RealtimeSettings, nested, replaced, setting, validate
from push_core.physics import ACTUATORS, Slider

from push_mpc.settings.controller_settings import ControllerSettings
from push_mpc.settings.diagnostics_settings import DiagnosticsSettings
from push_mpc.settings.pose_gate_settings import PoseGateSettings
from push_mpc.settings.presets import PRESETS, with_preset


@dataclass(frozen=True)
class MpcSettings(ControllerSettings):
    """Parameters of mpc_node."""

    track: str = setting('eight', 'eight, square, line, circle or a .csv file of x, y [m]')
    speed: float = setting(
        0.08, "speed of the object's centre along the track", unit='m/s', low=0.001, high=2.0
    )
    laps: int = setting(1, 'rounds of a closed track', low=1, high=1000)
    start_from: str = setting(
        'plan',
        'plan: the object has been put at the start of the track; here: the track is moved to '
        'begin where the object lies',
        choices=('plan', 'here'),
    )
    learn: bool = setting(
        False, 'take from gp_server what laps have taught; in lockstep wait for it after each'
    )
    planner: str = setting(
        'auto',
        'flat: sticking at p_y = 0; optimal: collocation, seconds; auto: flat where it exists',
        choices=('auto', 'flat', 'optimal'),
    )
    start_heading: str = setting(
        'free', 'of the object at the start in degrees, or free; a number needs the optimal plan'
    )
    end_heading: str = setting('free', 'of the object at the end, likewise')
    profile: str = setting(
        'irb120', 'robot whose lag the predictor assumes', choices=tuple(ACTUATORS)
    )
    preset: str = setting(
        'tuned', 'bundle of defaults; paper: the weights, h and N of the paper', choices=PRESETS
    )
    mode: str = setting(
        'realtime', 'clock: the system clock, or /clock', choices=('realtime', 'lockstep')
    )
    pose_loss: float = setting(
        1.5, 'age of the newest pose at which the controller stops', unit='s', low=0.011, high=10.0
    )
    poses: PoseGateSettings = nested(PoseGateSettings())
    diagnostics: DiagnosticsSettings = nested(DiagnosticsSettings())
    require_recorder: bool = setting(True, 'move only while the recorder records')
    realtime: RealtimeSettings = nested(RealtimeSettings())
    slider: Slider = nested(Slider())

    def __post_init__(self) -> None:
        validate(self)


_CHANGEABLE = (
    *('weights.', 'force_weights.', 'normal_speed_limit', 'tangential_speed_limit'),
    *('limits.speed', 'limits.acceleration', 'limits.deceleration'),
    *('recontact.', 'guard.', 'disturbance_length', 'pose_timeout', 'pose_loss'),
    *('require_recorder', 'diagnostics.'),
)


def is_changeable(name: str) -> bool:
    """Whether a parameter may change during a run: plan, table and solver are made of others."""
    return name.startswith(_CHANGEABLE)


_SLOW_CAMERAS = {'webcam': {'pose_timeout': 0.2, 'poses.max_age': 0.1}}
"""Profile, to what a slow camera needs: its `pose_timeout` [s] bears the loss of two pictures."""


def mpc_settings(profile: str, preset: str = 'tuned') -> MpcSettings:
    """Defaults for a robot profile and a preset; an unknown name is left to validation."""
    robot = replace(
        MpcSettings(),
        profile=profile,
        preset=preset,
        actuator=ACTUATORS.get(profile, MpcSettings().actuator),
    )
    return with_preset(replaced(robot, _SLOW_CAMERAS.get(profile, {})), preset)
