"""Planar geometry: frames, quaternions, displacements and twists."""
