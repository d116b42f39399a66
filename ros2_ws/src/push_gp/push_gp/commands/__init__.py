"""The commands of this package: train, evaluate, curve."""
