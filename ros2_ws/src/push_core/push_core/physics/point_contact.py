"""One point contact on a limit surface: mobility, motion cone, contact force of a push.

In the frame of the contact, whose x axis is the inward normal. The ellipsoid is isotropic in the
plane, so only the components of the contact position along normal and tangent enter. All functions
take numbers and arrays. Source: Mason 1986, Lynch et al. 1992.
"""

from typing import Any, TypeAlias, TypeVar

from push_core.geometry import Array

Real = TypeVar('Real', float, Array)
Mobility: TypeAlias = tuple[Any, Any, Any]


def mobility(normal: Any, tangential: Any, c_squared: float) -> Mobility:
    """Entries nn, nt, tt of M = J L J^T, which turns a contact force into its velocity.

    Args:
        normal: part of the contact's position along the inward normal [m].
        tangential: part along the tangent [m].
        c_squared: square of friction moment over friction force [m^2].
    """
    return (
        1.0 + tangential * tangential / c_squared,
        -normal * tangential / c_squared,
        1.0 + normal * normal / c_squared,
    )


def cone_edge(matrix: Mobility, friction: Any) -> tuple[Any, Any]:
    """Velocity [normal, tangential] along an edge of the motion cone.

    The sign of the friction coefficient selects the edge.
    """
    nn, nt, tt = matrix
    return nn + friction * nt, nt + friction * tt


def slip_sign(matrix: Mobility, friction: float, v_n: Any, v_t: Any) -> Any:
    """Sign of the tip's slip for a velocity into the object: 1, -1, or 0 where it sticks."""
    left, right = cone_edge(matrix, friction), cone_edge(matrix, -friction)
    # with high friction an edge may point backwards: no push into the face lies beyond it
    slides_left = (left[0] > 0.0) & (v_t * left[0] > left[1] * v_n)
    slides_right = (right[0] > 0.0) & (v_t * right[0] < right[1] * v_n)
    return slides_left * 1.0 - slides_right * 1.0


def sticking_force(matrix: Mobility, v_n: Real, v_t: Real) -> tuple[Real, Real]:
    """Force [normal, tangential] M^-1 v that moves the contact with the tip."""
    nn, nt, tt = matrix
    determinant = nn * tt - nt * nt
    return (tt * v_n - nt * v_t) / determinant, (nn * v_t - nt * v_n) / determinant


def sliding_force(matrix: Mobility, friction: Real, v_n: Real) -> tuple[Real, Real]:
    """Force on the friction cone's edge that gives the normal velocity of the tip."""
    f_n = v_n / cone_edge(matrix, friction)[0]
    return f_n, friction * f_n


def twist_of_force(
    normal: Any, tangential: Any, c_squared: float, f_n: Real, f_t: Real
) -> tuple[Real, Real, Real]:
    """Twist [normal, tangential, turning], scaled such that the translation is the force."""
    return f_n, f_t, (normal * f_t - tangential * f_n) / c_squared
