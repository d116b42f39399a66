"""Every run on record: recorder, reader, replay, score and report of MCAP bags."""
