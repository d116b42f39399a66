"""The plant as a ROS node, in real time or in lockstep."""

from push_sim.node.node_settings import NodeSettings, is_changeable, node_settings

__all__ = ['NodeSettings', 'is_changeable', 'node_settings']
