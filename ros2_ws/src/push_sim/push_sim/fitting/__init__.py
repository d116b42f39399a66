"""Least-squares fits of plant parameters to measurements."""
