"""The commands of this package: cell, bench, parameters."""
