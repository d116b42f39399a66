"""The reference and the planned horizon as markers, for viewers of standard messages."""

from collections.abc import Sequence

from geometry_msgs.msg import Point
from push_msgs.msg import Horizon, NominalTrajectory
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

_ON_TABLE = 0.001  # [m]
_ABOVE = 0.014  # [m]; the square is 13 mm high
_WIDTH = 0.004  # [m]
_SPACING = 0.004  # [m] between two points of the drawn reference
_GREY = ColorRGBA(r=0.55, g=0.6, b=0.65, a=1.0)
_AMBER = ColorRGBA(r=0.9, g=0.62, b=0.0, a=1.0)


def reference_marker(plan: NominalTrajectory) -> Marker:
    """The path of the object's centre as a line on the table."""
    line = _line('reference', plan, _thinned(plan.x, plan.y), _ON_TABLE)
    line.color = _GREY
    return line


def horizon_marker(horizon: Horizon) -> Marker:
    """The planned positions as a line above the object, which disappears after 0.2 s."""
    line = _line('horizon', horizon, list(zip(horizon.x, horizon.y, strict=True)), _ABOVE)
    line.color = _AMBER
    # replaced by the next horizon; disappears if there is none
    line.lifetime.nanosec = 200_000_000
    return line


def marker_array(reference: Marker | None, horizon: Marker | None) -> MarkerArray:
    """Both in one message, as far as they are known."""
    return MarkerArray(markers=[each for each in (reference, horizon) if each is not None])


def _line(
    name: str,
    source: NominalTrajectory | Horizon,
    places: Sequence[tuple[float, float]],
    height: float,
) -> Marker:
    line = Marker(header=source.header, ns=name, type=Marker.LINE_STRIP)
    line.scale.x = _WIDTH
    line.pose.orientation.w = 1.0
    line.points = [Point(x=x, y=y, z=height) for x, y in places]
    return line


def _thinned(x: Sequence[float], y: Sequence[float]) -> list[tuple[float, float]]:
    """The points that are `_SPACING` apart, and the last one."""
    places = list(zip(x, y, strict=True))
    kept = places[:1]
    for place in places:
        if (place[0] - kept[-1][0]) ** 2 + (place[1] - kept[-1][1]) ** 2 >= _SPACING**2:
            kept.append(place)
    return [*kept, *places[-1:]]
