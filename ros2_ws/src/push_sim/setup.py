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
            'sim_node = push_sim.node.sim_node:main',
            'bench = push_sim.commands.bench:main',
            'collect = push_sim.commands.collect:main',
            'validate = push_sim.commands.validate:main',
            'calibrate = push_sim.commands.calibrate:main',
        ],
    },
)
