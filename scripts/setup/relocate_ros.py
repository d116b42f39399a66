"""Makes the CMake files of the ROS wheels name this interpreter instead of their builder's."""

import re
import sys
import sysconfig
from pathlib import Path

import numpy as np

BUILDER = r'/opt/python/[^/;"]+'


def relocated(text: str) -> str:
    """The CMake text with the include folders of this Python and this numpy."""
    text = re.sub(rf'{BUILDER}/lib/[^;"]+/numpy/_?core/include', np.get_include(), text)
    return re.sub(rf'{BUILDER}/include/python[0-9.]+', sysconfig.get_paths()['include'], text)


def main() -> None:
    """Rewrites every exported target of this environment; again is harmless."""
    for path in Path(sys.prefix, 'share').glob('*/cmake/*Export.cmake'):
        before = path.read_text()
        after = relocated(before)
        if after != before:
            path.write_text(after)


if __name__ == '__main__':
    main()
