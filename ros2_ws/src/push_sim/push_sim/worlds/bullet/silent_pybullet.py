"""PyBullet without the greeting that it prints on standard error when it is imported."""

import os
import sys

sys.stderr.flush()
_standard_error = os.dup(2)
_nowhere = os.open(os.devnull, os.O_WRONLY)
os.dup2(_nowhere, 2)
try:
    import pybullet
finally:
    os.dup2(_standard_error, 2)
    os.close(_standard_error)
    os.close(_nowhere)

__all__ = ['pybullet']
