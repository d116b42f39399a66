"""Shared by all nodes: spinning, parameters, topics and services, diagnostics."""
