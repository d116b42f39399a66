"""The physics every part of the cell shares; numpy only."""
