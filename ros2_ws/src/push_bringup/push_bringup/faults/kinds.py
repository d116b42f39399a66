"""All kinds of faults."""

from push_bringup.faults.case import Fault
from push_bringup.faults.graph_faults import GRAPH_FAULTS
from push_bringup.faults.host_faults import HOST_FAULTS
from push_bringup.faults.pose_faults import POSE_FAULTS
from push_bringup.faults.process_faults import PROCESS_FAULTS
from push_bringup.faults.sick_faults import SICK_FAULTS

KINDS: dict[str, Fault] = {
    **PROCESS_FAULTS,
    **POSE_FAULTS,
    **SICK_FAULTS,
    **GRAPH_FAULTS,
    **HOST_FAULTS,
}
"""Every fault by its name."""
