"""Names of a package that are imported when they are first used.

A package offers its public names in one place, and `import push_mpc.settings` still loads neither
solver nor simulator. See PEP 562.
"""

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any


def lazy_exports(
    package: str, names: Mapping[str, Sequence[str]]
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """What a package's `__init__` needs to export names lazily.

    Args:
        package: its `__name__`.
        names: module or wing of the package, to the names that come from there.

    Returns:
        The package's `__getattr__`, `__dir__` and `__all__`.
    """
    homes = {name: f'{package}.{module}' for module, own in names.items() for name in own}

    def get(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f'module {package!r} has no attribute {name!r}')
        return getattr(import_module(homes[name]), name)

    return get, lambda: sorted(homes), sorted(homes)
