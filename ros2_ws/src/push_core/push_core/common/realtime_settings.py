"""What a process with a 10 ms loop asks of the kernel."""

from dataclasses import dataclass

from push_core.common.settings import setting, validate

ANY_CPU = -1


@dataclass(frozen=True)
class RealtimeSettings:
    """Scheduling of a node in real time; what the kernel refuses is left out, with a warning."""

    priority: int = setting(
        20, 'SCHED_FIFO priority of all threads; 0: ordinary scheduling', low=0, high=99
    )
    cpu: int = setting(
        ANY_CPU, 'number of the one core that all threads run on; -1: any', low=ANY_CPU, high=1023
    )
    lock_memory: bool = setting(False, 'keep the memory of the process from being paged out')

    def __post_init__(self) -> None:
        validate(self)
