"""The sections of docs/results.md: the command of each, its options and its introduction."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Section:
    """One command and its place in the page.

    Attributes:
        name: its key in results.json.
        title: its heading.
        text: what to know before the table.
        command: its name in `COMMANDS`.
        options: of the command; `{seeds}` and the like stand for options of `bench results`.
    """

    name: str
    title: str
    text: str
    command: str
    options: tuple[str, ...]

    @property
    def needs_data(self) -> bool:
        """Whether it needs measured pushes."""
        return any('{measured' in option for option in self.options)


SECTIONS = (
    Section(
        'table',
        "The paper's table",
        'Next to the errors of the real robot in the paper. `irb120` has the measured lag of the '
        'robot and the noise of its cameras, `ideal` neither. One set of parameters for all rows.',
        'table',
        ('--profile', 'irb120', 'ideal', '--seeds', '{seeds}'),
    ),
    Section(
        'harsh',
        'A harsh cell',
        'The same rows with the profile `harsh`: an uneven table, six times the noise, latency, '
        'jitter, lost images and commands (docs/worlds.md).',
        'table',
        ('--profile', 'harsh', '--controllers', 'gp', '--seeds', '{seeds}'),
    ),
    Section(
        'measured',
        'Trained on measured pushes',
        'The same lap with models of pushes that were measured on the real object. The plant is '
        'calibrated to the same pushes.',
        'data',
        ('--data', '{measured}', '--points', '10', '50', '200', '--draws', '{draws}'),
    ),
    Section(
        'training_size',
        'Training size',
        'The 8-track at 80 mm/s, profile `irb120`, with models of nested random draws from 10 000 '
        'simulated pushes and of the five pushes of a die. The paper: about 14 mm with 10 pushes, '
        'unstable with fewer random ones, 9 mm with the die in four laps of five, level with the '
        'analytical controller from about 200 on.',
        'data',
        ('--draws', '{draws}'),
    ),
    Section(
        'ablation',
        'The effect of each part',
        'The GP controller with parts switched off, profile `irb120`. `preset paper` has the '
        'literal weights, horizon and plan of the paper; control.md explains its errors. '
        'The last column is the rms change of the commanded velocity from tick to tick, on the '
        'eight at 80 mm/s.',
        'ablation',
        ('--seeds', '1'),
    ),
    Section(
        'mismatch',
        'Plants that the controller does not know',
        'Errors against the true pose, medians of the completed laps, profile `irb120`, one set '
        'of parameters and one model for all plants; nothing is learned on the job.',
        'mismatch',
        ('--seeds', '1'),
    ),
    Section(
        'learning',
        'Plants that the controller learns',
        'The same plants in runs of six laps that learn (docs/control.md): errors of the first, '
        'the second and the sixth lap. In the first one the motion cone is identified from every '
        '50 mm of path on, in the later ones the reference is shifted too.',
        'mismatch',
        (
            *('--seeds', '1', '--laps', '6', '--learn', '--rows', 'home'),
            *('friction_0.1', 'friction_0.3', 'friction_0.4', 'friction_0.6', 'rim', 'centred'),
            *('support_28', 'support_60', 'varies_0.2', 'varies_0.3', 'smaller', 'larger'),
            *('noise_0.5', 'webcam', 'half_lost'),
        ),
    ),
    Section(
        'solver_gp',
        'The QP solver: GP controller',
        'All QPs of a lap with perturbations: update and solve, CPU time of one thread.',
        'timing',
        ('--controller', 'gp'),
    ),
    Section(
        'solver_analytical',
        'The QP solver: Family of Modes',
        'Three QPs in each tick; their times add up.',
        'timing',
        ('--controller', 'analytical'),
    ),
    Section(
        'real_time',
        'In real time',
        'The node graph over DDS, recorded, next to the same laps in process; medians. On a host '
        'that takes the cores away commands are late, and after 0.5 s without a pose a lap ends.',
        'realtime',
        ('--runs', '{runs}'),
    ),
    Section(
        'plant',
        'The plant',
        'Measured pushes and robot runs, repeated in the simulator and with the ellipsoid that '
        'fits the short pushes best (docs/plant.md).',
        'validate',
        ('--data', '{measured.parent}'),
    ),
    Section(
        'learning_curve',
        'The model',
        'Mean NMSE in the push frame on measured pushes that the model has not seen, median '
        '(worst) of the seeds: a GP with zero mean, one over the fitted motion cone, and that '
        'cone alone (docs/model.md).',
        'curve',
        (
            *('{measured}', '--seeds', '{seeds}'),
            *('--points', '5', '10', '20', '50', '100', '200', '500', '1000'),
        ),
    ),
)
