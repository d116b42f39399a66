from setuptools import find_packages, setup

setup(
    name='push_bag',
    version='0.1.0',
    description='Recorder, reader, replay, score and report of runs in MCAP bags.',
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed', '*.js']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_bag']),
        ('share/push_bag', ['package.xml']),
    ],
    install_requires=[
        'setuptools',
        'foxglove-sdk',
        'lz4',
        'mcap',
        'numpy',
        'plotly',
        'PyYAML',
        'tqdm',
        'zstandard',
    ],
    extras_require={'test': ['pytest'], 'parquet': ['pyarrow==25.0.1']},
    zip_safe=False,
    entry_points={
        'push_sim.commanded_tip': ['bag = push_bag.run.commanded_tip:commanded_tip'],
        'console_scripts': [
            'recorder = push_bag.console:recorder',
            'score = push_bag.console:score',
            'info = push_bag.console:info',
            'replay = push_bag.console:replay',
            'live = push_bag.console:live',
            'markers = push_bag.console:markers',
            'recover = push_bag.console:recover',
            'export = push_bag.console:export',
            'import-csv = push_bag.console:import_csv',
        ],
    },
)
