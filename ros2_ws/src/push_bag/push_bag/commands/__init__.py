"""The commands of this package: score, info, export, replay, live, markers, import-csv."""
