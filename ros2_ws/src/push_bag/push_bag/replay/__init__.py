"""Publishing a bag again, and computing its commands again."""
