"""The model of a recorded run: the file in its bag, the pushes added, what its laps taught."""

from push_bag.file import BagReader
from push_core.common import InputError
from push_gp.models import PushModel
from push_gp.server import ModelServer
from push_gp.server.conversions import pushes_of
from push_msgs.msg import AddedPushes, Lesson
from push_node.endpoints import short_name
from push_node.interface import ADDED_PUSHES, LESSON


class RecordedModel:
    """A model that takes in the recorded `add_pushes` up to the tick that is recomputed."""

    def __init__(self, model: PushModel, max_points: int, reader: BagReader) -> None:
        """Reads the added pushes.

        Args:
            model: before the first added push.
            max_points: largest number of pushes.
            reader: of the bag.

        Raises:
            InputError: a message is not of its topic's type.
        """
        self._server = ModelServer(model, max_points)
        names = [name for name in reader.topics if short_name(name) == ADDED_PUSHES.short_name]
        added = sorted(reader.records(names), key=lambda record: record.log_ns)
        self._added = iter([record.message() for record in added])

    def grown_to(self, model_id: str) -> PushModel:
        """The model with an id; ids must be asked for in the order of the run.

        Raises:
            InputError: the model never has this id.
        """
        while self._server.info.model_id != model_id:
            added: AddedPushes | None = next(self._added, None)
            if added is None:
                raise InputError(
                    f'cannot recompute this run: it used model {model_id}, but the bag holds '
                    f'{self._server.info.model_id}; name a model file with --model'
                )
            self._server.add_pushes(pushes_of(added))
        return self._server.model


def recorded_lessons(reader: BagReader) -> list[Lesson]:
    """What laps of a run have taught, in the order of time.

    Raises:
        InputError: a message is not of its topic's type.
    """
    told = [each for each in reader.records() if short_name(each.topic.name) == LESSON.short_name]
    return [record.message() for record in sorted(told, key=lambda record: record.log_ns)]
