"""The bag format: MCAP records, message types, CDR, QoS and metadata."""

from push_bag.file.atomic_bag import atomic_bag
from push_bag.file.bag_contents import BagContents
from push_bag.file.bag_files import bag_files
from push_bag.file.bag_writer import COUNTS_RECORD, FACTS_RECORD, BagWriter
from push_bag.file.cdr_columns import COMPRESSED, Columns, columns, is_compressed
from push_bag.file.cdr_layout import Leaf, leaves
from push_bag.file.message_types import (
    Definition,
    installed_definition,
    message_class,
    schema_text,
)
from push_bag.file.qos_text import qos_profile, qos_text
from push_bag.file.reader import BagReader, Record
from push_bag.file.topic_registry import Schema, Topic
from push_bag.file.traffic import Traffic, TrafficLog, counted, lost_text
from push_bag.file.yaml_text import to_yaml

__all__ = [
    'COMPRESSED',
    'COUNTS_RECORD',
    'FACTS_RECORD',
    'BagContents',
    'BagReader',
    'BagWriter',
    'Columns',
    'Definition',
    'Leaf',
    'Record',
    'Schema',
    'Topic',
    'Traffic',
    'TrafficLog',
    'atomic_bag',
    'bag_files',
    'columns',
    'counted',
    'installed_definition',
    'is_compressed',
    'leaves',
    'lost_text',
    'message_class',
    'qos_profile',
    'qos_text',
    'schema_text',
    'to_yaml',
]
