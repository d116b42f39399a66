"""The model server node: `push_gp/predict`, `add_pushes`, `get_model`, `model_info`, `lesson`."""

import sys
from array import array
from collections.abc import Sequence
from pathlib import Path

from push_core.common import PushError
from push_core.data import PushSet
from push_msgs.srv import AddPushes, GetModel, Predict
from push_node import interface
from push_node.diagnostics import OK, Reporter
from push_node.parameters import declared
from push_node.spin import run_node
from rclpy.node import Node

from push_gp.learn import read_lesson
from push_gp.models import ANALYTICAL, model_named
from push_gp.server.conversions import (
    added_pushes_message,
    flat,
    lesson_message,
    model_info_message,
    pushes_of,
    queries_of,
)
from push_gp.server.model_server import ModelServer
from push_gp.server.server_settings import ServerSettings
from push_gp.server.teacher import Teacher

REPORT_PERIOD = 1.0


class GpServer(Node):  # type: ignore[misc]
    """Parameters, services and topics around a `ModelServer`."""

    def __init__(self) -> None:
        """Loads the model and announces it.

        Raises:
            InputError: a parameter or the model file is wrong.
        """
        super().__init__('gp_server', automatically_declare_parameters_from_overrides=True)
        settings = declared(self, ServerSettings())
        model = model_named(settings.model, settings.slider, settings.distance)
        self._file = _file_of(settings.model)
        self._server = ModelServer(model, settings.max_points)
        self._answered = self._refused = 0
        self._announcements = interface.MODEL_INFO.publisher(self)
        self._added = interface.ADDED_PUSHES.publisher(self)
        self._lessons = interface.LESSON.publisher(self) if settings.learn else None
        self._teacher = self._taught(settings) if settings.learn else None
        self._reporter = Reporter(self, 'model')
        self._entities = (
            interface.PREDICT.service(self, self._predict),
            interface.ADD_PUSHES.service(self, self._add_pushes),
            interface.GET_MODEL.service(self, self._get_model),
            self.create_timer(REPORT_PERIOD, self._report),
        )
        self._announce()

    def destroy_node(self) -> None:
        """Also ends what learns."""
        if self._teacher is not None:
            self._teacher.close()
        super().destroy_node()

    def _taught(self, settings: ServerSettings) -> Teacher:
        base, start = self._server.info.model_id, None
        if settings.lesson:
            start = read_lesson(Path(settings.lesson), settings.slider)
            self._server.serve(start.model or self._server.model)
        return Teacher(self, settings.mode, settings.slider, base, self._on_lesson, start)

    def _on_lesson(self) -> None:
        """Serves what the last lap or piece has taught."""
        assert self._teacher is not None
        model = self._teacher.known.model
        if model is not None:
            self._server.serve(model)
        self._announce()

    def _predict(self, request: Predict.Request, response: Predict.Response) -> Predict.Response:
        try:
            p_y, beta = queries_of(request)
            prediction = self._server.predict(p_y, beta, want_variance=request.want_variance)
        except PushError as error:
            self._refuse(response, error)
            return response
        self._accept(response)
        response.mean, response.jacobian = flat(prediction.mean), flat(prediction.jacobian)
        response.variance = flat(prediction.variance)
        return response

    def _add_pushes(
        self, request: AddPushes.Request, response: AddPushes.Response
    ) -> AddPushes.Response:
        try:
            pushes = pushes_of(request)
            response.message = '; '.join(self._server.add_pushes(pushes))
        except PushError as error:
            self._refuse(response, error)
        else:
            self._accept(response)
            self._announce_pushes(pushes)
            self._announce()
        response.points = self._server.info.points
        return response

    def _get_model(
        self, _request: GetModel.Request, response: GetModel.Response
    ) -> GetModel.Response:
        response.success = True
        response.name, content = self._file
        response.content = array('B', content)
        return response

    def _announce_pushes(self, pushes: PushSet) -> None:
        stamp = self.get_clock().now().to_msg()
        self._added.publish(added_pushes_message(pushes, self._server.info.model_id, stamp))

    def _accept(self, response: Predict.Response | AddPushes.Response) -> None:
        self._answered += 1
        response.success = True
        response.model_id = self._server.info.model_id

    def _refuse(self, response: Predict.Response | AddPushes.Response, error: PushError) -> None:
        self._refused += 1
        response.success = False
        response.message = str(error)
        response.model_id = self._server.info.model_id

    def _announce(self) -> None:
        info, stamp = self._server.info, self.get_clock().now().to_msg()
        if self._teacher is not None and self._lessons is not None:
            known, taught = self._teacher.known, self._teacher.taught
            self._lessons.publish(lesson_message(known, taught, info.model_id, stamp))
        self._announcements.publish(model_info_message(info, stamp))
        self.get_logger().info(
            f'serving {info.kind} model {info.model_id}: {info.points} pushes, '
            f'{info.mean_function} mean, {info.distance * 1e3:g} mm per push'
        )
        self._report()

    def _report(self) -> None:
        info = self._server.info
        values = {
            'model_id': info.model_id,
            'points': str(info.points),
            'answered': str(self._answered),
            'refused': str(self._refused),
        }
        self._reporter.report(OK, 'ready', values)


def _file_of(model: str) -> tuple[str, bytes]:
    """Name and content of a model file; both are empty for the analytical model."""
    return ('', b'') if model == ANALYTICAL else (Path(model).name, Path(model).read_bytes())


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the node; returns its exit status."""
    return run_node(GpServer, argv)


if __name__ == '__main__':
    sys.exit(main())
