"""Where the object will be when a command acts: delay predictor and disturbance estimate."""
