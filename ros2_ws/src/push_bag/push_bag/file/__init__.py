"""The bag format: MCAP records, message types, CDR, QoS and metadata."""
