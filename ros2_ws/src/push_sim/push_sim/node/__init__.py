"""The plant as a ROS node, in real time or in lockstep."""

from push_sim.node.node_settings import NodeSettings, node_settings

__all__ = ['NodeSettings', 'node_settings']
