"""Settings of the controller."""

from dataclasses import dataclass

from push_core.common import nested, setting, validate
from push_core.physics import ActuatorSettings, SafetyLimits

from push_mpc.settings.controllers import CONTROLLERS
from push_mpc.settings.guard_settings import GuardSettings
from push_mpc.settings.recontact import RecontactSettings

_CHANGE_SPEED = 0.08  # [m/s]
_DELAYS = 3.0  # of the robot; shortest filter of the model error along the last solution


def change_share(speed: float) -> float:
    """Factor of the weights on changes for a plan of a speed [m/s].

    A change of direction by the same angle costs the same at every speed.
    """
    return (_CHANGE_SPEED / speed) ** 2


@dataclass(frozen=True)
class Weights:
    """Diagonals of Q and R: cost per squared deviation from the nominal, and of the change."""

    position_x: float = setting(6000.0, 'object position, x', unit='1/m^2', low=0.0, high=1e9)
    position_y: float = setting(6000.0, 'object position, y', unit='1/m^2', low=0.0, high=1e9)
    heading: float = setting(1.0, 'object heading', unit='1/rad^2', low=0.0, high=1e9)
    contact: float = setting(1000.0, 'contact offset p_y', unit='1/m^2', low=0.0, high=1e9)
    normal: float = setting(10.0, 'normal velocity v_n', unit='s^2/m^2', low=1e-6, high=1e9)
    tangential: float = setting(1.0, 'tangential velocity v_t', unit='s^2/m^2', low=1e-6, high=1e9)
    change: float = setting(
        2.0, 'change of the velocity since the last command', unit='s^2/m^2', low=0.0, high=1e9
    )
    smoothness: float = setting(
        0.0,
        'change of the velocity from one step of the horizon to the next',
        unit='s^2/m^2',
        low=0.0,
        high=1e9,
    )

    def __post_init__(self) -> None:
        validate(self)


@dataclass(frozen=True)
class ForceWeights:
    """Diagonals of Q and R of the Family of Modes.

    Its forces are those of the paper: twist = grad H(force) with the factor lambda = 1, so that
    their magnitude is proportional to the speed. They are not contact forces in newtons, and have
    no unit.
    """

    position_x: float = setting(6000.0, 'object position, x', unit='1/m^2', low=0.0, high=1e9)
    position_y: float = setting(6000.0, 'object position, y', unit='1/m^2', low=0.0, high=1e9)
    heading: float = setting(1.0, 'object heading', unit='1/rad^2', low=0.0, high=1e9)
    contact: float = setting(30.0, 'contact offset p_y', unit='1/m^2', low=0.0, high=1e9)
    normal: float = setting(0.1, 'normal force f_n, at lambda = 1', low=1e-9, high=1e9)
    tangential: float = setting(0.01, 'tangential force f_t, at lambda = 1', low=1e-9, high=1e9)
    slip: float = setting(1.0, 'slip of the tip', unit='s^2/m^2', low=1e-9, high=1e9)
    change: float = setting(
        40.0,
        'change of slip, and of the speeds that the forces make, since the last command',
        unit='s^2/m^2',
        low=0.0,
        high=1e9,
    )

    def __post_init__(self) -> None:
        validate(self)


@dataclass(frozen=True)
class ControllerSettings:
    """Model-predictive control about a timed nominal trajectory."""

    controller: str = setting(
        'gp',
        '; '.join(f'{name}: {kind.text}' for name, kind in CONTROLLERS.items()),
        choices=tuple(CONTROLLERS),
    )
    period: float = setting(0.01, 'time between two ticks', unit='s', low=0.001, high=0.1)
    horizon_steps: int = setting(20, 'steps of the horizon', low=2, high=200)
    horizon_length: float = setting(
        0.084, 'path that the horizon spans', unit='m', low=0.001, high=1.0
    )
    horizon_step: float = setting(
        0.0,
        'time of a step of the horizon; 0: horizon_length decides',
        unit='s',
        low=0.0,
        high=1.0,
    )
    weights: Weights = nested(Weights())
    force_weights: ForceWeights = nested(ForceWeights())
    normal_speed_limit: float = setting(
        0.25, 'largest v_n; the smallest is 0', unit='m/s', low=1e-3, high=2.0
    )
    tangential_speed_limit: float = setting(
        0.15,
        'largest |v_t|, of the Family of Modes largest |slip|',
        unit='m/s',
        low=1e-3,
        high=2.0,
    )
    relinearise: bool = setting(
        False, 'linearise each QP of gp along the last solution; false: about the nominal'
    )
    sideways_response: float = setting(
        1.0,
        "factor on the object's sideways velocity per v_t in the QP of gp; 1: that of the model, "
        '-1: as in the matrices of the paper',
        low=-1.0,
        high=1.0,
    )
    consistent_plan: bool = setting(
        True, "re-plan with the model's own motion equations when a model arrives"
    )
    disturbance_length: float = setting(
        0.05,
        'filter length of the model-error estimate; 0 switches it off',
        unit='m',
        low=0.0,
        high=10.0,
    )
    delay_compensation: bool = setting(
        True, 'roll the measured state forward through the commands already sent'
    )
    pose_timeout: float = setting(
        0.1,
        'age of the newest poses up to which their prediction serves; then the tip is held',
        unit='s',
        low=0.011,
        high=1.0,
    )
    recontact: RecontactSettings = nested(RecontactSettings())
    actuator: ActuatorSettings = nested(ActuatorSettings())
    command_timeout: float = setting(
        0.05,
        'time without a command until the driver brakes',
        unit='s',
        low=0.001,
        high=10.0,
    )
    limits: SafetyLimits = nested(SafetyLimits())
    good_poses: int = setting(10, 'poses in a row before anything moves', low=1, high=1000)
    guard: GuardSettings = nested(GuardSettings())

    def __post_init__(self) -> None:
        validate(self)

    def filter_length(self, speed: float) -> float:
        """Travel [m] over which the model error is estimated along a plan of a speed [m/s].

        Commands under way cannot answer to an estimate: it must not change faster than they do.
        """
        if self.disturbance_length == 0.0:
            return 0.0
        delays = max(CONTROLLERS[self.controller].filter_delays, _DELAYS * self.relinearise)
        delay = self.actuator.dead_time + self.actuator.lag
        return max(self.disturbance_length, delays * speed * delay)
