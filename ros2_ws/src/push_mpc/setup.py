from setuptools import find_packages, setup

setup(
    name='push_mpc',
    version='0.1.0',
    description=(
        'The controllers: nominal plan, tabulated model, delay predictor and the quadratic '
        'program solved every 10 ms.'
    ),
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_mpc']),
        ('share/push_mpc', ['package.xml']),
    ],
    install_requires=['setuptools', 'casadi', 'numpy', 'osqp', 'scipy'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'mpc_node = push_mpc.console:mpc_node',
        ],
    },
)
