"""The parameters that a run changed, in a few words."""

_NAMED = 2


def changes_in_words(changed: str | None) -> list[str]:
    """What a label adds about changed parameters.

    Args:
        changed: NAME=VALUE of each, separated by commas, as in the facts; None if unknown.

    Returns:
        Their names and values, or their number where there are many; nothing without a change.
    """
    if not changed:
        return []
    count = changed.count('=')
    return [changed if count <= _NAMED else f'{count} changed parameters']
