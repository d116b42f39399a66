"""The model of a recorded run: the file in its bag, and what `add_pushes` made of it."""

from push_bag.file import BagReader
from push_core.common import InputError
from push_gp.models import PushModel
from push_gp.server import ModelServer
from push_gp.server.conversions import pushes_of
from push_msgs.msg import AddedPushes
from push_node.endpoints import short_name
from push_node.interface import ADDED_PUSHES


class RecordedModel:
    """A model that grows again as it grew while the run was recorded."""

    def __init__(self, model: PushModel, max_points: int, reader: BagReader) -> None:
        """Reads the pushes that were added.

        Args:
            model: as it was at first.
            max_points: that it may grow to.
            reader: of the bag.

        Raises:
            InputError: a message is not of its topic's type.
        """
        self._server = ModelServer(model, max_points)
        names = [name for name in reader.topics if short_name(name) == ADDED_PUSHES.short_name]
        self._added = iter([record.message() for record in reader.records(names)])

    def grown_to(self, model_id: str) -> PushModel:
        """The model once it had an id; later ones than that of the call before.

        Raises:
            InputError: it never had.
        """
        while self._server.info.model_id != model_id:
            added: AddedPushes | None = next(self._added, None)
            if added is None:
                raise InputError(
                    f'cannot compute this run again: it used model {model_id}, but the bag holds '
                    f'{self._server.info.model_id}; name a model file with --model'
                )
            self._server.add_pushes(pushes_of(added))
        return self._server.model
