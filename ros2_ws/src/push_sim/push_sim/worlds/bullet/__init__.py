"""The PyBullet engine."""

from push_sim.worlds.bullet.bullet_world import BulletWorld

__all__ = ['BulletWorld']
