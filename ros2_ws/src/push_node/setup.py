from setuptools import find_packages, setup

setup(
    name='push_node',
    version='0.1.0',
    description=(
        'What every node of the cell shares: spinning, parameters from settings, quality of '
        'service, diagnostics.'
    ),
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_node']),
        ('share/push_node', ['package.xml']),
    ],
    install_requires=['setuptools', 'PyYAML'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
)
