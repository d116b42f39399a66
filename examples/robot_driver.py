"""Stands for a robot: a velocity-controlled arm (250 Hz, reliable) and motion capture (100 Hz).

It keeps the contract of docs/robot.md with QoS, rates and stamps of its own, and has no reset:
the controller starts where the object lies. Run it in place of sim_node.
"""

import sys
import time
from collections import deque

import numpy as np
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_core import Slider
from push_core.geometry import yaw_to_quaternion
from push_node.spin import run_node
from push_sim import make_world, profile
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data

SLIDER = Slider()
OBJECT = np.array([0.05, -0.03, 0.4])  # x [m], y [m], theta [rad]: anywhere
SERVO, EXPOSURE = 0.004, 0.01  # [s]
DEAD_TIME, LAG, WATCHDOG = 0.04, 0.03, 0.05  # [s]


class Robot(Node):  # type: ignore[misc]
    """Arm and cameras around a physics engine."""

    def __init__(self) -> None:
        super().__init__('robot')
        self.world = make_world(profile('irb120').world, SLIDER)
        self.world.reset(OBJECT, SLIDER.tip_position(OBJECT, 0.0, 0.005))
        self.commands: deque[tuple[float, np.ndarray]] = deque()
        self.target = self.velocity = np.zeros(2)
        self.time = self.fed = time.monotonic()
        self.tip_poses = self.create_publisher(PoseStamped, 'pusher_pose', 10)
        self.object_poses = self.create_publisher(
            PoseStamped, 'object_pose', qos_profile_sensor_data
        )
        self.exposed = self.pose(OBJECT)
        self.create_subscription(TwistStamped, 'pusher_velocity_cmd', self.on_command, 1)
        self.create_timer(SERVO, self.servo)
        self.create_timer(EXPOSURE, self.expose)

    def on_command(self, message: TwistStamped) -> None:
        """Queues a velocity in the world frame until the dead time is over."""
        self.fed = time.monotonic()
        linear = message.twist.linear
        self.commands.append((self.fed + DEAD_TIME, np.array([linear.x, linear.y])))

    def servo(self) -> None:
        """Moves the tip up to now; the position is read when it is published."""
        while self.time + SERVO <= time.monotonic():
            self.time += SERVO
            while self.commands and self.commands[0][0] <= self.time:
                self.target = self.commands.popleft()[1]
            if self.time - self.fed > WATCHDOG:
                self.commands.clear()
                self.target = np.zeros(2)
            self.velocity = self.velocity + (self.target - self.velocity) * SERVO / LAG
            self.world.advance((self.velocity[0], self.velocity[1]), round(SERVO * 1000))
        self.tip_poses.publish(self.pose(np.array([*self.world.tip_position, 0.0])))

    def expose(self) -> None:
        """Publishes the last exposure: the cameras need one period for the reconstruction."""
        self.object_poses.publish(self.exposed)
        self.exposed = self.pose(self.world.object_pose)

    def pose(self, planar: np.ndarray) -> PoseStamped:
        """A measurement that is taken now."""
        message = PoseStamped()
        message.header.frame_id = 'world'
        message.header.stamp = self.get_clock().now().to_msg()
        message.pose.position.x, message.pose.position.y = map(float, planar[:2])
        turn = message.pose.orientation
        turn.x, turn.y, turn.z, turn.w = yaw_to_quaternion(float(planar[2]))
        return message


if __name__ == '__main__':
    sys.exit(run_node(Robot))
