"""Messages of a running cell for viewers in a browser."""
