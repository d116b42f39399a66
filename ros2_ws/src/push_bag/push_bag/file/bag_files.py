"""Finds the MCAP files of a bag; names files that are something else."""

import re
from collections.abc import Sequence
from pathlib import Path

import yaml
from push_core.common import InputError

from push_bag.file.rosbag2_metadata import FILE_NAME
from push_bag.file.yaml_text import from_yaml

SUFFIX = '.mcap'
HEAD = 16  # [B] that tell the format of a file
UNPACK = {
    b'\x28\xb5\x2f\xfd': 'zstd -d {path} -o {unpacked}',
    b'\x04\x22\x4d\x18': 'lz4 -d {path} {unpacked}',
    b'\x1f\x8b': 'gunzip -c {path} > {unpacked}',
    b'BZh': 'bunzip2 -c {path} > {unpacked}',
    b'\xfd7zXZ': 'unxz -c {path} > {unpacked}',
    b'PK\x03\x04': 'unzip {path}',
}
"""Commands that unpack a compressed file, by its first bytes."""
OTHERS = {
    b'SQLite format 3': 'is a bag in SQLite; `ros2 bag convert` makes an MCAP bag of it',
    b'#ROSBAG V2.0': 'is a bag of ROS 1; `rosbags-convert` makes a bag of ROS 2 of it',
}
PACKED = ('.zstd', '.zst', '.lz4', '.gz', '.bz2', '.xz', '.zip')
_NUMBER = re.compile(r'^(.*?)_?(\d+)$')


def bag_files(path: Path) -> list[Path]:
    """The MCAP files of a bag in their order.

    Args:
        path: MCAP file, or run folder; a folder's `metadata.yaml` states which files and in
            which order.

    Raises:
        InputError: there is none, they are unrelated, or one is compressed or not readable.
    """
    files = _files_of_folder(path) if path.is_dir() else [path]
    for file in files:
        _check(file)
    return files


def _files_of_folder(folder: Path) -> list[Path]:
    there = sorted(each for each in folder.iterdir() if each.suffix == SUFFIX)
    listed = _listed(folder)
    if len(there) == 1 and len(listed) < 2:
        return there
    if listed:
        return [_present(folder, name) for name in listed]
    if not there:
        raise InputError(_nothing_in(folder))
    numbers = [_NUMBER.match(each.stem) for each in there]
    stems = {number[1] if number else '' for number in numbers}
    if len(stems) > 1 or not all(numbers):
        raise InputError(f'{folder} holds {len(there)} MCAP files; name the one to read')
    return sorted(there, key=_number)


def _number(file: Path) -> int:
    found = _NUMBER.match(file.stem)
    return int(found[2]) if found else 0


def _listed(folder: Path) -> Sequence[str]:
    """Names of the files as `metadata.yaml` lists them; empty without a readable one."""
    try:
        text = (folder / FILE_NAME).read_text(encoding='utf-8')
        names = from_yaml(text)['rosbag2_bagfile_information']['relative_file_paths']
    except (OSError, ValueError, yaml.YAMLError, KeyError, TypeError):
        return []
    return [str(name) for name in names] if isinstance(names, list) else []


def _present(folder: Path, name: str) -> Path:
    """A listed file, or the one that was unpacked from it.

    The first versions of rosbag2 listed the name of the folder, too.
    """
    names = [name, Path(name).name]
    names += [each.removesuffix(suffix) for each in names for suffix in PACKED]
    for each in names:
        if (folder / each).suffix == SUFFIX and (folder / each).is_file():
            return folder / each
    if (folder / name).exists():
        return folder / name
    raise InputError(
        f'{folder / name} is missing, which {FILE_NAME} lists; name the files that are there'
    )


def _nothing_in(folder: Path) -> str:
    packed = sorted(each for each in folder.iterdir() if each.suffix in (*PACKED, '.db3'))
    for each in packed:
        _check(each)
    return f'{folder} holds no MCAP file; name a run folder or an MCAP file'


def _check(path: Path) -> None:
    """Refuses what can never be read.

    Raises:
        InputError: it does not exist, is no file, is not readable, or of another known format.
    """
    if not path.exists():
        raise InputError(f'{path} does not exist; name a run folder or an MCAP file')
    if not path.is_file():
        raise InputError(
            f'{path} is a pipe or a device; a bag is read more than once, so save it to a file '
            'first, such as with `cat PIPE > bag.mcap`'
        )
    try:
        with path.open('rb') as stream:
            head = stream.read(HEAD)
    except OSError as error:
        raise InputError(f'{path} cannot be read: {error.strerror}') from error
    for begin, command in UNPACK.items():
        if head.startswith(begin):
            raise InputError(
                f'{path} is compressed; unpack it with '
                f'`{command.format(path=path, unpacked=_unpacked(path))}`'
            )
    for begin, text in OTHERS.items():
        if head.startswith(begin):
            raise InputError(f'{path} {text}')


def _unpacked(path: Path) -> Path:
    return path.with_suffix('') if path.suffix in PACKED else path.with_suffix('.unpacked.mcap')
