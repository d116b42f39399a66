"""The look of every HTML page: style, figures, and the plotting library they carry."""
