"""The recorder node."""

from push_bag.record.recorder_settings import RecorderSettings, split_list

__all__ = ['RecorderSettings', 'split_list']
