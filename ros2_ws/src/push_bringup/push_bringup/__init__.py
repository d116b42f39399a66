"""The cell as a whole: one parameter file, the command that runs it, the benchmarks."""
