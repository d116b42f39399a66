"""Recovery of the intact part of a damaged bag."""
