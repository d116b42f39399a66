"""A zip archive of a JSON header and arrays, sealed with a checksum.

`numpy.load` and `unzip -p FILE header.json` open it too. Its zip comment is the sha256 of all
bytes before it and is checked first: a damaged file never reaches a parser.
"""

import hashlib
import io
import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import InputError, write_atomically
from push_core.geometry import Array

HEADER = 'header.json'
SEAL_LENGTH = 64


def write_sealed(path: Path, header: Mapping[str, Any], arrays: Mapping[str, Array]) -> None:
    """Writes header and arrays atomically; the same content gives the same bytes.

    Raises:
        InputError: the file cannot be written.
    """
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, 'w') as archive:
        _add(archive, HEADER, (json.dumps(header, indent=2) + '\n').encode())
        for name, values in arrays.items():
            _add(archive, f'{name}.npy', _npy(values))
        archive.comment = b'0' * SEAL_LENGTH
    content = buffer.getvalue()[:-SEAL_LENGTH]
    write_atomically(path, content + _seal(content))


def read_sealed(path: Path) -> tuple[dict[str, Any], dict[str, Array]]:
    """Header and arrays of a sealed archive.

    Raises:
        InputError: the file is missing, damaged, or has no seal.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f'cannot read {path}: {error.strerror}') from error
    if content[-SEAL_LENGTH:] != _seal(content[:-SEAL_LENGTH]):
        raise InputError(
            f'{path}: is damaged or no model file; make one with: train PUSHES.csv -o MODEL.npz'
        )
    return _parsed(path, content)


def _parsed(path: Path, content: bytes) -> tuple[dict[str, Any], dict[str, Array]]:
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            header = json.loads(archive.read(HEADER))
            names = [name for name in archive.namelist() if name != HEADER]
            arrays = {name.removesuffix('.npy'): _array(archive.read(name)) for name in names}
    except (zipfile.BadZipFile, KeyError, ValueError) as error:
        raise InputError(f'{path}: is no model file ({error})') from error
    if not isinstance(header, dict):
        raise InputError(f'{path}: is no model file (its header is no object)')
    return header, arrays


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    # a ZipInfo has a fixed date, so that equal models are equal files
    archive.writestr(zipfile.ZipInfo(name), content)


def _npy(values: Array) -> bytes:
    buffer = io.BytesIO()
    np.lib.format.write_array(
        buffer, np.ascontiguousarray(values, '<f8'), version=(1, 0), allow_pickle=False
    )
    return buffer.getvalue()


def _array(content: bytes) -> Array:
    values = np.lib.format.read_array(io.BytesIO(content), allow_pickle=False)
    return np.asarray(values, dtype=np.float64)


def _seal(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode()
