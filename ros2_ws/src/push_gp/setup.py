from setuptools import find_packages, setup

setup(
    name='push_gp',
    version='0.1.0',
    description='Gaussian processes of planar pushing, and the server that answers for them.',
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_gp']),
        ('share/push_gp', ['package.xml']),
    ],
    install_requires=['setuptools', 'numpy', 'plotly', 'scipy', 'threadpoolctl', 'tqdm'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'gp_server = push_gp.console:gp_server',
            'train = push_gp.console:train',
            'curve = push_gp.console:curve',
            'evaluate = push_gp.console:evaluate',
        ],
    },
)
