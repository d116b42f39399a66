"""What a run needs before it starts: request, parameters, default model, run folder."""
