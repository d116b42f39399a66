"""The plant: a PyBullet world with the lag of the robot and the noise of the cameras."""
