"""The model as a bicubic table, and how it is filled from a model server."""
