import os

import pytest
from push_core.common.atomic_file import check_place, write_atomically
from push_core.common.errors import InputError


def test_a_file_is_replaced_and_a_link_followed(tmp_path) -> None:
    target, link = tmp_path / 'target', tmp_path / 'link'
    target.write_bytes(b'old')
    link.symlink_to(target)
    write_atomically(link, b'new')
    assert (target.read_bytes(), link.is_symlink()) == (b'new', True)
    assert sorted(each.name for each in tmp_path.iterdir()) == ['link', 'target']


@pytest.mark.parametrize(
    ('place', 'fault'),
    [
        ('', 'is a folder'),
        ('none/file', 'there is no folder'),
        ('pipe', 'a device or a pipe'),
        ('/proc/file', 'cannot write'),
    ],
)
def test_what_cannot_be_written_is_refused_before_and_left_alone(tmp_path, place, fault) -> None:
    os.mkfifo(tmp_path / 'pipe')
    for attempt in (check_place, lambda path: write_atomically(path, b'content')):
        with pytest.raises(InputError, match=fault):
            attempt(tmp_path / place)
    assert (tmp_path / 'pipe').is_fifo()
    assert len(list(tmp_path.iterdir())) == 1
