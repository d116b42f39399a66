"""The nominal: state and input along a track."""
