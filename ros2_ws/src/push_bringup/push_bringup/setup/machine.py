"""What figures depend on beside the program's options: its revision, libraries and machine."""

import os
import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

_LIBRARIES = ('numpy', 'scipy', 'osqp', 'casadi', 'pybullet', 'mcap', 'rclpy')
_CPU_FACTS = Path('/proc/cpuinfo')


def versions() -> dict[str, str]:
    """Version of each library that figures depend on."""
    return {name: _version(name) for name in _LIBRARIES}


def processor() -> str:
    """Kind and number of the cores."""
    facts = _CPU_FACTS.read_text(encoding='utf-8') if _CPU_FACTS.is_file() else ''
    models = [line.split(':')[1].strip() for line in facts.splitlines() if 'model name' in line]
    return f'{models[0] if models else platform.machine()}, {os.cpu_count()} cores'


def git_revision() -> str:
    """Of the program, with a word if files were changed since; 'unknown' outside a repository."""
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
