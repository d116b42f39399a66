"""A recorded run as arrays."""
