"""Whether a lap was completed."""

END_DISTANCE = 0.050  # [m] from object to reference
END_GAP = 1.0e-3  # [m] between tip and pushed face


def is_completed(
    arrived: bool, distance: float, gap: float, contact_offset: float, side: float
) -> bool:
    """Whether a lap was completed: the object is near the end, with the tip on the pushed face.

    Args:
        arrived: the reference came to its end, and the controller did not stop before.
        distance: from the object's centre to the reference at the end [m].
        gap: between tip and pushed face at the end [m].
        contact_offset: p_y at the end [m].
        side: of the square [m].
    """
    on_face = gap <= END_GAP and abs(contact_offset) <= side / 2.0
    return bool(arrived and distance <= END_DISTANCE and on_face)
