"""Low-rank kernels: Chebyshev modes of the kernel, for large training sets."""
