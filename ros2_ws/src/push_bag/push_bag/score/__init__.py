"""The score of a run: tracking, contact, timing, messages."""
