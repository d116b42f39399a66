"""What a figure depends on besides its options: sources, libraries, machine."""

import hashlib
import importlib.util
import os
import platform
import subprocess
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

MODEL_SOURCES = ('push_core', 'push_gp', 'push_sim')
"""Packages that decide which model a set of simulated pushes gives."""
LAP_SOURCES = (*MODEL_SOURCES, 'push_bag', 'push_bringup', 'push_mpc', 'push_node')
"""Packages that decide how a lap in process goes and how it is scored."""
_NUMERICAL = ('numpy', 'scipy', 'osqp', 'casadi', 'pybullet')
_LIBRARIES = (*_NUMERICAL, 'mcap', 'rclpy')
_CPU_FACTS = Path('/proc/cpuinfo')


@cache
def source_revision(packages: tuple[str, ...] = LAP_SOURCES) -> str:
    """Hash of the Python sources of packages, as installed."""
    digest = hashlib.sha256()
    for package in sorted(packages):
        spec = importlib.util.find_spec(package)
        for folder in (spec.submodule_search_locations if spec else None) or ():
            digest.update(f'{package} {hash_of_sources(Path(folder))}\n'.encode())
    return digest.hexdigest()


def hash_of_sources(folder: Path) -> str:
    """Hash of names and bytes of all Python files below a folder."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob('*.py')):
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        digest.update(f'{path.relative_to(folder).as_posix()} {content}\n'.encode())
    return digest.hexdigest()


@cache
def code_key(packages: tuple[str, ...] = LAP_SOURCES) -> str:
    """Hash of the sources of packages and of the versions of Python and numerical libraries."""
    libraries = [f'{name} {_version(name)}' for name in _NUMERICAL]
    parts = (source_revision(packages), platform.python_version(), *libraries)
    return hashlib.sha256('\n'.join(parts).encode()).hexdigest()


def versions() -> dict[str, str]:
    """Version of each library that figures depend on."""
    return {name: _version(name) for name in _LIBRARIES}


def processor() -> str:
    """Model and number of the cores."""
    facts = _CPU_FACTS.read_text(encoding='utf-8') if _CPU_FACTS.is_file() else ''
    models = [line.split(':')[1].strip() for line in facts.splitlines() if 'model name' in line]
    return f'{models[0] if models else platform.machine()}, {os.cpu_count()} cores'


def git_revision() -> str:
    """The commit of the sources, marked if files were changed; 'unknown' outside a repository."""
    folder = str(Path(__file__).resolve().parent)
    command = ['git', '-C', folder, 'describe', '--always', '--dirty']
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=5, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return 'unknown'
    return done.stdout.strip() or 'unknown'


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return 'unknown'
