"""The commands of this package: score, info, export, replay, live, import-csv."""
