"""Settings of the plant, and the profiles that bundle them."""
