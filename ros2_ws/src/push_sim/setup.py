from setuptools import find_packages, setup

setup(
    name='push_sim',
    version='0.1.0',
    description='The plant: a PyBullet world, the lag of the robot and the noise of the cameras.',
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_sim']),
        ('share/push_sim', ['package.xml']),
    ],
    install_requires=['setuptools', 'numpy', 'plotly', 'pybullet', 'scipy', 'tqdm'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'sim_node = push_sim.console:sim_node',
            'bench = push_sim.console:bench',
            'collect = push_sim.console:collect',
            'validate = push_sim.console:validate',
            'calibrate = push_sim.console:calibrate',
        ],
    },
)
