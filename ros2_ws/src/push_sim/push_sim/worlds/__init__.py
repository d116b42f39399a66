"""The physics engines behind one interface."""
