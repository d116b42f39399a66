"""Data sets of pushes and their CSV files, and the prediction error on them."""
