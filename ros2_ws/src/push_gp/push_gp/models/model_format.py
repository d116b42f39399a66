"""What a model file says of itself; apart, so that a look at a file needs no mathematics."""

FORMAT = 'push_gp model'
VERSION = 3
CONVENTIONS = {
    'units': 'metres and radians',
    'frame': 'body frame at the start of the push, x along the inward normal of the pushed face',
    'inputs': 'p_y: contact offset along the face; beta = atan2(v_n, v_t): push direction',
    'outputs': 'dx, dy, dtheta: displacement of the centre and rotation by a push of distance_m',
    'kernel': "signal_std^2 exp(-sum_j (x_j - x_j')^2 / lengthscale_j^2), noise_std^2 added",
    'arrays': 'inputs (n, 2), displacement (n, 3), weights (3, n)',
}
