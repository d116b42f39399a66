"""The model as a bicubic table, and how it is filled from a model server."""

from push_mpc.table.domain import Domain
from push_mpc.table.surrogate import Table
from push_mpc.table.tabulation import (
    Answer,
    Conversation,
    Question,
    Subject,
    Tabulated,
    tabulation,
)

__all__ = [
    'Answer',
    'Conversation',
    'Domain',
    'Question',
    'Subject',
    'Table',
    'Tabulated',
    'tabulation',
]
