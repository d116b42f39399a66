"""The plant beside measurements: errors, tables, pages."""
