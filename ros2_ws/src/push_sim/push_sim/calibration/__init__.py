"""Plant parameters fitted to measurements, and the parameter file made of them."""
