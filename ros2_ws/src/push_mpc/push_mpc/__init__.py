"""The controllers: nominal plan, tabulated model, delay predictor and the quadratic program solved every 10 ms."""
