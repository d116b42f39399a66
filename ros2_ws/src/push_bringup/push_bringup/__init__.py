"""The cell as a whole: one parameter file, the cell command that runs a node graph, the launch file and the benchmarks."""
