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
        'console_scripts': [
            'recorder = push_bag.record.recorder:main',
            'score = push_bag.commands.score:main',
            'info = push_bag.commands.info:main',
            'replay = push_bag.commands.replay:main',
            'live = push_bag.commands.live:main',
            'markers = push_bag.commands.markers:main',
            'recover = push_bag.repair.recover:main',
            'export = push_bag.commands.export:main',
            'import-csv = push_bag.commands.import_csv:main',
        ],
    },
)
