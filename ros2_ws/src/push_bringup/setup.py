from pathlib import Path

from setuptools import find_packages, setup

setup(
    name='push_bringup',
    version='0.1.0',
    description=(
        'The cell as a whole: one parameter file, the cell command that runs a node graph, '
        'the launch file and the benchmarks.'
    ),
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_bringup']),
        ('share/push_bringup', ['package.xml']),
        ('share/push_bringup/config', [str(path) for path in Path('config').glob('*.*')]),
        ('share/push_bringup/launch', [str(path) for path in Path('launch').glob('*.py')]),
    ],
    install_requires=['setuptools', 'numpy', 'osqp', 'plotly', 'PyYAML', 'rich', 'scipy', 'tqdm'],
    extras_require={
        'test': ['pytest'],
        'bench': ['clarabel', 'daqp', 'gpytorch', 'piqp', 'proxsuite', 'scikit-learn', 'torch'],
    },
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'bench = push_bringup.console:bench',
            'cell = push_bringup.console:cell',
            'check_driver = push_bringup.console:check_driver',
            'faults = push_bringup.console:faults',
            'parameters = push_bringup.console:parameters',
            'start = push_bringup.console:start',
        ],
        'push_bag.qp': ['cell = push_bringup.in_process.qp_of_tick:qp_text'],
        'push_bag.recompute': ['cell = push_bringup.in_process.recompute:recomputed'],
    },
)
