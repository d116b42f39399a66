"""The nodes of a cell as processes, from start to stop."""
