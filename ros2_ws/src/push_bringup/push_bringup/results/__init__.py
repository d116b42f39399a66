"""The published figures: one JSON file, and the documents that quote it."""

from push_bringup.results.documents import document_paths, quoted, results_page
from push_bringup.results.figures import figures
from push_bringup.results.results_file import Results, read_results, write_results

__all__ = [
    'Results',
    'document_paths',
    'figures',
    'quoted',
    'read_results',
    'results_page',
    'write_results',
]
