"""A recorded controller, given its poses again, sends what it sent: bit for bit."""

from dataclasses import replace

import numpy as np
import pytest
from push_bag.commands.replay import main as replay
from push_bag.file.bag_writer import BagWriter
from push_bag.file.reader import BagReader
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run.recorded_ticks import RecordedRun
from push_bringup.in_process.loop import InProcessCell, nanoseconds
from push_bringup.in_process.qp_of_tick import qp_text
from push_bringup.in_process.record import InProcessRecord
from push_bringup.in_process.tables import tabulated
from push_bringup.setup.cell_parameters import CellParameters, node_defaults
from push_core.common.errors import InputError
from push_gp.models.model_file import load_model, model_named
from push_gp.server.conversions import added_pushes_message
from push_gp.server.model_server import ModelServer
from push_mpc.loop.controller import Mode
from push_mpc.plan.planning import planned
from push_node.stamps import to_seconds, to_stamp
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
    """A run that goes on without a pose, waits for one, is stopped, and started once more."""
    folder = tmp_path_factory.mktemp('recorded') / 'run'
    attached = {
        'params.yaml': parameters.as_yaml().encode(),
        model_file.name: model_file.read_bytes(),
    }
    model = model_named(str(model_file), parameters.gp.slider)
    cell = InProcessCell(parameters, model, planned(parameters.mpc))
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
        if number in {30, 31}:
            tick = controller.coast(to_seconds(now))
            record.tick(None, tick, 0.0)
            controller.prepare_next()
        elif number in {40, 80}:
            tick = controller.hold(to_seconds(now))
            record.controller_tick(tick, origin + now + 1, 0.0)
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


def test_the_qps_of_a_tick_are_solved_again(eventful):
    tick = next(tick for tick in RecordedRun(eventful).ticks() if tick.number == 60)
    told = qp_text(eventful, 60).splitlines()
    assert told[0] == f'tick 60: {Mode(tick.mode).name}'
    assert told[1].startswith('QP 1 of 1: 124 variables')
    assert ': solved, ' in told[2]
    violation = float(told[3].split('largest violation ')[1].split()[0])
    assert violation < 1e-6


def test_a_tick_without_a_qp_is_refused(eventful):
    with pytest.raises(InputError, match='without a QP'):
        qp_text(eventful, 5)
    with pytest.raises(InputError, match='has no tick 100000'):
        qp_text(eventful, 100000)


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


@pytest.fixture(scope='module')
def grown(parameters, model_file, tmp_path_factory):
    """A run during which pushes were added twice; the first addition was never used."""
    folder = tmp_path_factory.mktemp('grown') / 'run'
    attached = {
        'params.yaml': parameters.as_yaml().encode(),
        model_file.name: model_file.read_bytes(),
    }
    model = load_model(model_file)
    cell = InProcessCell(parameters, model, planned(parameters.mpc))
    server = ModelServer(model, parameters.gp.max_points)
    with BagWriter(folder, {}, attached) as writer:
        record = InProcessRecord(writer, cell.plant, cell.controller)
        record.head(parameters.mpc, model.info)
        writer.add_topic('/added_pushes', 'push_msgs/msg/AddedPushes', '')
        _push_and_learn(cell, record, server, writer)
    cell.close()
    return folder


def _push_and_learn(cell, record, server, writer):
    controller, observation = cell.controller, cell._reset()
    controller.arm()
    for number in range(80):
        if number == 40:
            for scale in (1.05, 1.1):
                writer.write('/added_pushes', serialize_message(added(server, scale)), 1, 1)
            table = tabulated(server.model, controller.settings.slider.side)
            controller.use(controller.prepare_model(table, server.info.model_id))
        tick = controller.step(
            observation.object_pose, observation.tip_position, observation.time, cell.plant.time
        )
        record.tick(observation, tick, 0.0)
        controller.prepare_next()
        cell.plant.command(tick.velocity, cell.plant.time)
        observation = cell.plant.step()


def added(server, scale):
    """A server takes in some of its own pushes with longer displacements, and tells of them."""
    few = server.model.pushes.take(np.arange(5))
    further = replace(few, p_y=few.p_y * scale, displacement=few.displacement * scale)
    server.add_pushes(further)
    return added_pushes_message(further, server.info.model_id, to_stamp(0))


def test_a_model_that_grew_is_grown_again(grown, capsys):
    used = {tick.model_id for tick in RecordedRun(grown).ticks()}
    assert len(used) == 2
    assert replay([str(grown), '--recompute']) == 0
    assert capsys.readouterr().out == '80 of 80 commands are the same, bit for bit\n'


def test_another_weight_leaves_the_model_to_grow_and_another_model_does_not(grown, model_file):
    heavier = recomputed(grown, Changes(params={'weights.contact': 500.0}))
    assert heavier.differs.any()
    # the same file under another name is used throughout: right until the model grew
    fixed = recomputed(grown, Changes(model=model_file))
    assert not fixed.differs[:40].any()
    assert fixed.differs[40:].any()


def test_a_run_whose_added_pushes_are_not_in_the_bag_is_refused(grown, tmp_path, capsys):
    names = [each.topic.name for each in BagReader(grown).records()]
    lossy = without(grown, tmp_path / 'lossy', names.index('/added_pushes'))
    assert replay([str(lossy), '--recompute']) == 2
    error = capsys.readouterr().err
    assert 'cannot recompute this run: it used model' in error
    assert error.count('\n') == 1
