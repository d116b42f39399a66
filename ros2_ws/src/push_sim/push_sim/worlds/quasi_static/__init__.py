"""The quasi-static engine: motion cone of an ellipsoidal limit surface."""
