"""Topics and time span of a bag, from one pass through it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from push_core.common import InputError
from push_node.endpoints import short_name

from push_bag.file import COMPRESSED, BagReader, Topic, is_compressed


@dataclass(frozen=True)
class Survey:
    """Topics and time span of a bag.

    Attributes:
        topics: selected topics with messages, by full name.
        first_ns: earliest log time of any message in the bag [ns].
        last_ns: latest log time on the selected topics [ns].
        disorder_ns: how much earlier a message's log time is than that of one before it in the
            file, at most [ns].
        further_types: name and type of topics that have another type in `topics`, too.
    """

    topics: Mapping[str, Topic]
    first_ns: int
    last_ns: int
    disorder_ns: int
    further_types: frozenset[tuple[str, str]] = frozenset()

    @property
    def seconds(self) -> float:
        """Time [s] from the beginning of the bag to the last message of the selected topics."""
        return (self.last_ns - self.first_ns) * 1e-9


def survey(path: Path, names: Sequence[str] | None) -> Survey:
    """Surveys a bag.

    Args:
        path: run folder or MCAP file.
        names: of the topics to select, full or last part only; None for all.

    Raises:
        InputError: there is no readable bag, it is empty, or lacks a topic.
    """
    reader = BagReader(path)
    spans: dict[str, tuple[int, int]] = {}
    latest = disorder = 0
    for record in reader.records():
        latest = max(latest, record.log_ns)
        disorder = max(disorder, latest - record.log_ns)
        if is_compressed(record.data):
            raise InputError(f'{record.topic.name}: {COMPRESSED}')
        first, last = spans.get(record.topic.name, (record.log_ns, record.log_ns))
        spans[record.topic.name] = min(first, record.log_ns), max(last, record.log_ns)
    topics = _selected({name: reader.topics[name] for name in spans}, names)
    seen = [spans[name] for name in topics]
    if not seen:
        raise InputError(
            f'{reader.path} holds no messages' + (' of these topics' if names else '')
        )
    begin = min(first for first, _ in spans.values())
    kinds = {(each.name, each.type_name) for each in reader.all_topics if each.name in topics}
    kinds -= {(name, topic.type_name) for name, topic in topics.items()}
    return Survey(topics, begin, max(last for _, last in seen), disorder, frozenset(kinds))


def _selected(topics: Mapping[str, Topic], names: Sequence[str] | None) -> dict[str, Topic]:
    if names is None:
        return dict(topics)
    selected: dict[str, Topic] = {}
    for name in names:
        matches = [full for full in topics if name in (full, full[1:], short_name(full))]
        if not matches:
            known = ', '.join(sorted(topics))
            raise InputError(f'the bag has no message of a topic {name}; it has those of {known}')
        selected |= {full: topics[full] for full in matches}
    return selected
