"""The model as a bicubic table, and how it is filled from a model server."""

from push_mpc.table.domain import Domain
from push_mpc.table.inertia import table_at_speed
from push_mpc.table.surrogate import Table
from push_mpc.table.tabulation import (
    ModelScope,
    Query,
    QueryResult,
    Tabulated,
    Tabulation,
    tabulation,
)

__all__ = [
    'Domain',
    'ModelScope',
    'Query',
    'QueryResult',
    'Table',
    'Tabulated',
    'Tabulation',
    'table_at_speed',
    'tabulation',
]
