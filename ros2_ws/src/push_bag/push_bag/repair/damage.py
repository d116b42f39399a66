"""Ways in which the bytes of a file can be spoilt, for testing what reads them."""

import random
from collections.abc import Callable

LONGEST_SWAP = 100  # [B]
LONGEST_HOLE = 2000  # [B]


def cut(whole: bytearray, chance: random.Random) -> bytearray:
    """The file ends somewhere."""
    return whole[: chance.randrange(len(whole))]


def flipped(whole: bytearray, chance: random.Random) -> bytearray:
    """Some bits are wrong."""
    for _ in range(chance.choice((1, 8, 64))):
        whole[chance.randrange(len(whole))] ^= 1 << chance.randrange(8)
    return whole


def swapped(whole: bytearray, chance: random.Random) -> bytearray:
    """Some pieces have changed places."""
    for _ in range(4):
        here, there = (chance.randrange(len(whole) - LONGEST_SWAP) for _ in range(2))
        size = chance.randrange(1, LONGEST_SWAP)
        whole[here : here + size], whole[there : there + size] = (
            whole[there : there + size],
            whole[here : here + size],
        )
    return whole


def taken_out(whole: bytearray, chance: random.Random) -> bytearray:
    """A piece is missing, and what follows has moved up."""
    at = chance.randrange(len(whole))
    del whole[at : at + chance.randrange(1, LONGEST_HOLE)]
    return whole


DAMAGES: tuple[Callable[[bytearray, random.Random], bytearray], ...] = (
    cut,
    flipped,
    swapped,
    taken_out,
)
