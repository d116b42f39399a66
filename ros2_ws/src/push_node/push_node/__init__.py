"""What every node of the cell shares: spinning, parameters, quality of service, diagnostics."""
