"""Recovery of what is whole in a broken bag."""
