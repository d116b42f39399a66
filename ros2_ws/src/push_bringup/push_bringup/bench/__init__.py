"""The benchmarks, one module each, and their pages."""
