"""The contents of a bag, printed and extracted."""

import pytest
from push_bag.commands.info import main


def test_info_prints_topics_rates_losses_and_facts(record, capsys):
    run = record(missing={'object_pose': (60, 61)}, facts={'operator': 'nobody'})
    assert main([str(run)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].endswith(', finished')
    (poses,) = (line.split() for line in lines if line.startswith('/object_pose'))
    received, lost, rate, gap = (float(word) for word in poses[2:])
    assert (received, lost) == (189, 2)
    assert rate == pytest.approx(99.0, abs=1.0)
    assert gap == pytest.approx(30.0, abs=0.1)
    assert 'operator: nobody' in lines
    assert 'attached: params.yaml, 5 B' in lines


def test_attachments_are_extracted_to_a_new_folder(perfect, tmp_path, capsys):
    parts = tmp_path / 'parts'
    assert main([str(perfect), '--extract', str(parts)]) == 0
    assert {path.name: path.read_bytes() for path in parts.iterdir()} == {'params.yaml': b'a: 1\n'}
    capsys.readouterr()
    assert main([str(perfect), '--extract', str(parts)]) == 2
    assert 'exists; name a new folder' in capsys.readouterr().err


def test_a_failed_extraction_leaves_no_folder(perfect, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, 'No space left on device')

    monkeypatch.setattr('push_core.common.atomic_file.os.fsync', full)
    assert main([str(perfect), '--extract', str(tmp_path / 'parts')]) == 2
    assert list(tmp_path.iterdir()) == []
