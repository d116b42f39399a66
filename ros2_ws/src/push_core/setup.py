from setuptools import find_packages, setup

setup(
    name='push_core',
    version='0.1.0',
    description=(
        'The physics every part of the cell shares: frames, slider, limit surface, motion '
        'cone, tracks, actuator, safety limits.'
    ),
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_core']),
        ('share/push_core', ['package.xml']),
    ],
    install_requires=['setuptools', 'numpy', 'scipy'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
)
