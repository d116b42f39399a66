"""How the loop has been since the last report: rate, times, and what went wrong, with levels."""

import math
from collections import Counter
from collections.abc import Mapping

from push_core.physics import LIMIT_NAMES
from push_node.diagnostics import ERROR, WARN, Finding, above

from push_mpc.loop import MOVING, Mode, Tick
from push_mpc.settings import DiagnosticsSettings


class LoopHealth:
    """Counts in the loop; a timer takes the findings and begins anew."""

    def __init__(self, period: float) -> None:
        """Starts counting.

        Args:
            period: time [s] between two ticks.
        """
        self._period = period
        self._limited: Counter[int] = Counter()
        self._totals: Counter[str] = Counter()
        self._begin()

    def _begin(self) -> None:
        self._ticks = self._moving = self._held = self._late = 0
        self._solve_ms = self._tick_ms = 0.0

    def note(self, tick: Tick, tick_ms: float) -> None:
        """Takes one tick and its duration [ms]."""
        self._ticks += 1
        self._moving += tick.mode in MOVING
        self._held += tick.mode == Mode.HOLDING
        self._late += tick_ms > 1e3 * self._period
        self._solve_ms = max(self._solve_ms, tick.solve_ms)
        self._tick_ms = max(self._tick_ms, tick_ms)
        if tick.limited:
            self._limited[tick.limited] += 1

    def take(
        self, seconds: float, totals: Mapping[str, int], settings: DiagnosticsSettings
    ) -> tuple[list[Finding], dict[str, str]]:
        """Findings and values since the last call.

        Args:
            seconds: since then; infinite where time says nothing, as in lockstep.
            totals: what went wrong elsewhere since the start: refused poses and the like.
            settings: thresholds.
        """
        rate = self._ticks / seconds if math.isfinite(seconds) else math.nan
        values = {
            'rate_hz': f'{rate:.1f}',
            'solve_ms_max': f'{self._solve_ms:.2f}',
            'tick_ms_max': f'{self._tick_ms:.2f}',
            'late_ticks': str(self._late),
            'holding_ticks': str(self._held),
            **{name: str(total) for name, total in sorted(totals.items())},
            **{f'limited_{name}': str(self._limited_by(bit)) for bit, name in LIMIT_NAMES.items()},
        }
        findings = [*self._loop_findings(rate, settings), *self._news(totals)]
        self._begin()
        return findings, values

    def _loop_findings(self, rate: float, settings: DiagnosticsSettings) -> list[Finding]:
        if math.isnan(rate):
            return []
        slowest = f'a tick took {self._tick_ms:.1f} ms'
        found = [above(1e-3 * self._tick_ms, settings.tick_warn, settings.tick_error, slowest)]
        if 0 < self._moving == self._ticks:
            slow = f'{rate:.0f} ticks a second'
            found.append(above(-rate, -settings.rate_warn, -settings.rate_error, slow))
        held = f'no fresh pose for {self._held} ticks' if self._held else ''
        return [*found, (WARN, held)]

    def _news(self, totals: Mapping[str, int]) -> list[Finding]:
        """What was refused or failed since the last call."""
        news = Counter(totals)
        news.subtract(self._totals)
        self._totals = Counter(totals)
        return [(WARN, f'{name} {count}') for name, count in news.items() if count > 0]

    def _limited_by(self, bit: int) -> int:
        return sum(count for bits, count in self._limited.items() if bits & bit)


def stop_finding(reason: str, on_request: str) -> Finding:
    """A stop that was asked for is a warning, any other an error."""
    return WARN if reason == on_request else ERROR, reason
