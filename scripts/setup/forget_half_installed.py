"""Lets pip install again what an interruption left half written.

pip writes RECORD last but believes in a package as soon as its METADATA is there.
"""

import shutil
import sysconfig
from pathlib import Path


def main() -> None:
    """Removes the metadata of every package of this environment that has no RECORD."""
    for metadata in Path(sysconfig.get_paths()['purelib']).glob('*.dist-info'):
        if not (metadata / 'RECORD').exists():
            shutil.rmtree(metadata)


if __name__ == '__main__':
    main()
