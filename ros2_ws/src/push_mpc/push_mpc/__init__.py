"""The controllers: nominal plan, tabulated model, delay predictor, tracking quadratic program."""
