"""Mechanics of pushing: slider, limit surface, contact, motion cone, actuator, speed limits."""
