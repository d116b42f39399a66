"""Faults put into a running cell, and what each must lead to."""

from push_bringup.faults.case import Case, Fault, Outcome, Verdict

__all__ = ['Case', 'Fault', 'Outcome', 'Verdict']
