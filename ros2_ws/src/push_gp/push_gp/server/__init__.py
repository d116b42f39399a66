"""The model server: answers queries for means, variances and Jacobians over ROS."""

from push_gp.server.model_server import ModelServer
from push_gp.server.server_settings import ServerSettings

__all__ = ['ModelServer', 'ServerSettings']
