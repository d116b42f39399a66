"""Tables of models as mpc_node makes them, by direct calls in place of the service."""

import numpy as np
from push_gp.models import PushModel
from push_mpc.table import Domain, ModelScope, Query, QueryResult, Table, tabulation


def tabulated(model: PushModel, side: float) -> Table:
    """The table of a model on the face of a slider with a `side` [m]."""
    info = model.info
    data = Domain.of_data(info.p_y_domain, info.beta_domain, side)
    queries = tabulation(ModelScope(data, info.kind, info.mean_function, side))
    query = next(queries)
    try:
        while True:
            query = queries.send(_result(model, query))
    except StopIteration as done:
        return done.value.table  # type: ignore[no-any-return]


def _result(model: PushModel, query: Query) -> QueryResult:
    inputs = (query.p_y, query.beta)
    variance = model.variance(*inputs) if query.want_variance else np.empty((0, 3))
    return QueryResult.of(*model.evaluate(*inputs), variance, model.distance)
