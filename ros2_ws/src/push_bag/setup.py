from setuptools import find_packages, setup

setup(
    name='push_bag',
    version='0.1.0',
    description='Every run on record: recorder, reader, replay, score and report of MCAP bags.',
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed', '*.js', 'plotly/*']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_bag']),
        ('share/push_bag', ['package.xml']),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest'], 'parquet': ['pyarrow==25.0.1']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'recorder = push_bag.recorder:main',
            'score = push_bag.score_command:main',
            'info = push_bag.info:main',
            'replay = push_bag.replay:main',
            'live = push_bag.live:main',
            'recover = push_bag.recover:main',
            'bench = push_bag.recorder_bench:main',
            'fuzz = push_bag.fuzz:main',
            'export = push_bag.export:main',
            'import-csv = push_bag.import_csv:main',
        ],
    },
)
