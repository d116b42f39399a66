"""What is not about pushing: errors, settings, files, worker processes, command lines."""
