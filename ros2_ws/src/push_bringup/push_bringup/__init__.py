"""The cell as a whole: one parameter file, the command that runs it, the benchmarks."""

from typing import TYPE_CHECKING

from push_core.lazy import lazy_exports

if TYPE_CHECKING:
    from push_bringup.in_process import InProcessCell as InProcessCell
    from push_bringup.in_process import tabulated as tabulated
else:
    __getattr__, __dir__, __all__ = lazy_exports(
        __name__,
        {
            'in_process': ['InProcessCell', 'tabulated'],
        },
    )
