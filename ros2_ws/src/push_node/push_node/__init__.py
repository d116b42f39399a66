"""What every node of the cell shares: spinning, parameters from settings, quality of service, diagnostics."""
