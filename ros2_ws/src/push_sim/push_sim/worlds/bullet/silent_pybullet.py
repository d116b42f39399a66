"""Imports PyBullet without the message that it prints on standard error."""

import os
import sys

sys.stderr.flush()
_standard_error = os.dup(2)
_devnull = os.open(os.devnull, os.O_WRONLY)
os.dup2(_devnull, 2)
try:
    import pybullet
finally:
    os.dup2(_standard_error, 2)
    os.close(_standard_error)
    os.close(_devnull)

__all__ = ['pybullet']
