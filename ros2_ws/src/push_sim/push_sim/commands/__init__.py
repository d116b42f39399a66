"""The commands of this package: collect, validate, calibrate, bench."""
