"""The benchmarks by name."""

BENCHES = {
    'table': ('push_bringup.bench.paper_table', "the paper's experiments, all controllers"),
    'data': ('push_bringup.bench.training_size', 'error of the GP controller over training size'),
    'ablation': ('push_bringup.bench.ablation', 'what each part of the controller is worth'),
    'mismatch': (
        'push_bringup.mismatch.bench_mismatch',
        'plants that the controller does not know',
    ),
    'model': ('push_bringup.bench.libraries', 'our Gaussian processes next to public libraries'),
    'timing': ('push_bringup.bench.solver_times', 'the QPs of a lap by several solvers'),
    'realtime': ('push_bringup.bench.real_time', "the paper's experiments in real time"),
    'stopping': ('push_bringup.bench.stopping', 'how long a cell takes to end after Ctrl-C'),
    'results': ('push_bringup.results.results', 'runs these and writes docs/results.md'),
}
"""Word after `bench`, to the module whose `main` runs it, and what it measures."""
