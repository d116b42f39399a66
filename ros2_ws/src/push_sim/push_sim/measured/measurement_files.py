"""The measurement files of a folder, told apart by the columns that they name."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from push_core.common import InputError
from push_core.data import column_names, long_push_csv, push_csv, robot_run

SHORT_PUSHES = 'short pushes'
LONG_PUSHES = 'long pushes'
ROBOT_RUNS = 'robot runs'
COLUMNS: Mapping[str, tuple[str, ...]] = {
    SHORT_PUSHES: push_csv.COLUMNS,
    LONG_PUSHES: long_push_csv.COLUMNS,
    ROBOT_RUNS: robot_run.COLUMNS,
}
"""Kind of measurement, to the columns of its files."""
SUFFIXES = ('.csv', '.txt', '.tsv', '.dat')
_KNOWN = frozenset().union(*COLUMNS.values())


@dataclass
class MeasurementFiles:
    """The files of a folder and of those in it.

    Attributes:
        folder: that was searched.
        of_kind: kind of measurement, to its files by name.
        left_out: other files, with the reason.
    """

    folder: Path
    of_kind: dict[str, list[Path]] = field(default_factory=lambda: {kind: [] for kind in COLUMNS})
    left_out: dict[Path, str] = field(default_factory=dict)

    def name(self, path: Path) -> str:
        """How results call a file: its path from the folder on, or its name if it lies there."""
        return path.relative_to(self.folder).as_posix()

    def sha256(self) -> str:
        """Hash of all measurement files, kind by kind, in the order of their names."""
        digest = hashlib.sha256()
        for paths in self.of_kind.values():
            for path in paths:
                digest.update(path.read_bytes())
        return digest.hexdigest()


def measurement_files(folder: Path) -> MeasurementFiles:
    """Finds the measurement files of a folder.

    Raises:
        InputError: the folder does not exist, or a file cannot be read.
    """
    if not folder.is_dir():
        raise InputError(f'{folder} is no folder; name the one with the measured pushes')
    found = MeasurementFiles(folder)
    seen: dict[str, Path] = {}
    for path in sorted(folder.rglob('*')):
        if path.is_dir() or any(part.startswith('.') for part in path.relative_to(folder).parts):
            continue
        kind, reason = _kind(path)
        if kind:
            content = hashlib.sha256(path.read_bytes()).hexdigest()
            first = seen.setdefault(content, path)
            reason = '' if first == path else f'is a copy of {found.name(first)}'
        if reason:
            found.left_out[path] = reason
        else:
            found.of_kind[kind].append(path)
    return found


def _kind(path: Path) -> tuple[str, str]:
    """Kind of measurement, or else an empty string and why it is none."""
    if path.suffix.lower() not in SUFFIXES:
        return '', f'is no table ({", ".join(SUFFIXES)})'
    try:
        names = set(column_names(path, tuple(_KNOWN)))
    except InputError as error:
        return '', str(error).removeprefix(f'{path}: ')
    for kind, columns in COLUMNS.items():
        if names >= set(columns):
            return kind, ''
    kind = max(COLUMNS, key=lambda each: len(names & set(COLUMNS[each])))
    if not names & set(COLUMNS[kind]):
        return '', 'names no columns of pushes or robot runs'
    missing = [name for name in COLUMNS[kind] if name not in names]
    return '', f'lacks {", ".join(missing)} of {kind}'
