"""A recorded controller, given its poses again, sends what it sent: bit for bit."""

from dataclasses import replace

import numpy as np
import pytest
from push_bag.bag_writer import BagWriter
from push_bag.reader import BagReader
from push_bag.recompute import Changes, recomputed
from push_bag.replay import main as replay
from push_bringup.cell_parameters import CellParameters, node_defaults
from push_bringup.in_process import InProcessCell, nanoseconds
from push_bringup.in_process_record import InProcessRecord
from push_core.errors import InputError
from push_gp.model_source import model_named
from push_mpc.controller import Mode, Tick
from push_node.stamps import to_seconds
from rclpy.serialization import serialize_message

TICKS = 150


@pytest.fixture(scope='module')
def parameters(model_file):
    settings = node_defaults('irb120')
    settings['mpc_node'] = replace(settings['mpc_node'], track='line', mode='lockstep')
    settings['gp_server'] = replace(settings['gp_server'], model=str(model_file))
    return CellParameters(*settings.values())


@pytest.fixture(scope='module')
def eventful(parameters, model_file, tmp_path_factory):
    """A run that waits for a late pose, is stopped, released and started once more."""
    folder = tmp_path_factory.mktemp('recorded') / 'run'
    attached = {
        'params.yaml': parameters.as_yaml().encode(),
        model_file.name: model_file.read_bytes(),
    }
    model = model_named(str(model_file), parameters.gp.slider)
    cell = InProcessCell(parameters, model)
    with BagWriter(folder, {}, attached) as writer:
        record = InProcessRecord(writer, cell.plant, cell.controller)
        record.head(parameters.mpc, model.info)
        _push(cell, record)
    cell.close()
    return folder


def _push(cell, record):
    controller, plant, observation = cell.controller, cell.plant, cell._reset()
    origin = nanoseconds(observation.time)
    events = {3: controller.arm, 80: lambda: controller.stop('asked to')}
    events |= {90: controller.resume, 95: controller.arm}
    for number in range(TICKS):
        events.get(number, lambda: None)()
        seen, now = (nanoseconds(time) - origin for time in (observation.time, plant.time))
        poses = observation.object_pose, observation.tip_position
        if number == 40:
            tick = controller.hold(to_seconds(now))
            record.told(tick, origin + now + 1, 0.0)
        elif number == 80:
            tick = Tick(Mode.STOPPED, np.zeros(2))
            record.told(tick, origin + now + 1, 0.0)
        else:
            tick = controller.step(*poses, to_seconds(seen), to_seconds(now))
            record.tick(observation, tick, 0.0)
            controller.prepare_next()
        if tick.mode != Mode.IDLE:
            plant.command(tick.velocity, plant.time)
        observation = plant.step()


def without(source, folder, lost=None, **attached):
    """A copy of a bag without one message, and with other attachments."""
    reader = BagReader(source)
    records = list(reader.records())
    with BagWriter(folder, reader.facts, reader.attachments | attached) as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, topic.qos)
        for number, each in enumerate(records):
            if number != lost:
                writer.write(each.topic.name, *each[1:])
    return folder


def test_the_same_settings_give_the_same_bits(eventful, capsys):
    assert replay([str(eventful), '--recompute']) == 0
    assert capsys.readouterr().out == '142 of 142 commands are the same, bit for bit\n'


def test_another_weight_gives_other_commands_and_no_failure(eventful, tmp_path, capsys):
    page = tmp_path / 'both.html'
    words = [str(eventful), '--recompute', '-p', 'weights.contact:=100.0', '--html', str(page)]
    assert replay(words) == 0
    assert 'difference: rms' in capsys.readouterr().out
    assert page.stat().st_size < 6e6


def test_the_other_controller_is_asked_at_each_tick_anew(eventful):
    found = recomputed(eventful, Changes(controller='analytical'))
    moving = np.hypot(*found.recorded.T) > 0.05
    assert found.stamp.size == 142
    assert found.differs[moving].all()
    assert np.abs(found.computed[:, 0] - found.recorded[:, 0])[moving].mean() < 0.03


def test_a_lost_pose_is_counted_and_fails_the_check(eventful, tmp_path, capsys):
    names = [each.topic.name for each in BagReader(eventful).records()]
    lost = [number for number, name in enumerate(names) if name == '/object_pose'][60]
    lossy = without(eventful, tmp_path / 'lossy', lost)
    assert replay([str(lossy), '--recompute']) == 1
    assert '1 commands not computed' in capsys.readouterr().out


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (['--model', 'none.npz'], 'none.npz'),
        (['-p', 'mpc_node.nonsense:=1'], 'unknown parameter'),
        (['-p', 'weights.contact'], 'NAME:=VALUE'),
    ],
)
def test_a_change_that_is_not_possible_is_one_line_and_status_2(eventful, capsys, words, reason):
    assert replay([str(eventful), '--recompute', *words]) == 2
    error = capsys.readouterr().err
    assert reason in error
    assert error.count('\n') == 1


def test_another_model_than_that_of_the_run_is_refused(eventful, model_file, tmp_path):
    reader = BagReader(eventful)
    next(reader.records())
    text = reader.attachments['params.yaml'].decode()
    other = text.replace(str(model_file), 'analytical').encode()
    bag = without(eventful, tmp_path / 'other', **{'params.yaml': other})
    with pytest.raises(InputError, match=r'it used model \w{12}, but the bag holds \w{12}; name'):
        recomputed(bag, Changes())


def test_a_run_whose_model_grew_is_refused_by_the_name_of_what_is_missing(
    eventful, tmp_path, capsys
):
    """What a model became by `add_pushes` is not in the bag."""
    reader, grown = BagReader(eventful), tmp_path / 'grown'
    records = list(reader.records())
    with BagWriter(grown, reader.facts, reader.attachments) as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, topic.qos)
        for number, each in enumerate(records):
            data = each.data
            if each.topic.name == '/controller_state' and number > len(records) // 2:
                state = each.message()
                state.model_id = 'grown0000000'
                data = serialize_message(state)
            writer.write(each.topic.name, data, *each[2:])
    assert replay([str(grown), '--recompute']) == 2
    error = capsys.readouterr().err
    assert 'changed (add_pushes) to grown0000000, but the bag holds' in error
    assert error.count('\n') == 1
