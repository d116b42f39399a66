"""Time stamps from and to nanoseconds."""

from builtin_interfaces.msg import Time

NANOSECONDS = 1_000_000_000


def to_stamp(nanoseconds: int) -> Time:
    """A time stamp of whole nanoseconds."""
    return Time(sec=nanoseconds // NANOSECONDS, nanosec=nanoseconds % NANOSECONDS)


def to_nanoseconds(stamp: Time) -> int:
    """Whole nanoseconds of a time stamp."""
    return int(stamp.sec) * NANOSECONDS + int(stamp.nanosec)


def to_seconds(nanoseconds: int) -> float:
    """A duration of whole nanoseconds in seconds."""
    return nanoseconds / NANOSECONDS
