"""Thresholds of the levels on /diagnostics."""

from dataclasses import dataclass

from push_core.common import InputError, setting, validate


@dataclass(frozen=True)
class DiagnosticsSettings:
    """When the status of mpc_node is a warning or an error, of each second."""

    tick_warn: float = setting(
        0.005, 'slowest tick that is a warning', unit='s', low=0.0, high=10.0
    )
    tick_error: float = setting(
        0.01, 'slowest tick that is an error', unit='s', low=0.0, high=10.0
    )
    rate_warn: float = setting(
        95.0, 'rate of ticks in a run below which it is a warning', unit='1/s', low=0.0, high=1e3
    )
    rate_error: float = setting(
        50.0, 'rate of ticks in a run below which it is an error', unit='1/s', low=0.0, high=1e3
    )

    def __post_init__(self) -> None:
        validate(self)
        if self.tick_warn > self.tick_error or self.rate_warn < self.rate_error:
            raise InputError('diagnostics: a warning must come before the error')
