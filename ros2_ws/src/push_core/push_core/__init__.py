"""The physics every part of the cell shares: frames, slider, limit surface, motion cone, tracks, actuator, safety limits. numpy only."""
