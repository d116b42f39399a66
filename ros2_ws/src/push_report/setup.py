from setuptools import find_packages, setup

setup(
    name='push_report',
    version='0.1.0',
    description='The look of every HTML page: style, figures, plotting library.',
    license='Apache-2.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed', '*.css', '*.js', 'plotly/*']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/push_report']),
        ('share/push_report', ['package.xml']),
    ],
    install_requires=['setuptools', 'numpy', 'plotly'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
)
