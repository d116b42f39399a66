"""Set-up on machines where something is missing, without installing anything."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LOCKS = ('ros', 'run', 'dev')


@pytest.fixture
def project(tmp_path):
    """A fresh clone, as far as set-up looks at it before it installs."""
    for name in ('scripts', 'requirements'):
        shutil.copytree(ROOT / name, tmp_path / 'clone' / name)
    (tmp_path / 'clone/ros2_ws/src').mkdir(parents=True)
    return tmp_path / 'clone'


@pytest.fixture
def tools(tmp_path):
    """A PATH with what set-up itself uses, and neither compiler nor Python."""
    folder = tmp_path / 'tools'
    folder.mkdir()
    used = 'bash sh env cat awk df dirname basename readlink sha256sum mkdir mv rm flock make find'
    for name in used.split():
        path = shutil.which(name)
        assert path is not None, name
        (folder / name).symlink_to(path)
    return folder


def add_tool(tools, name, script):
    (tools / name).write_text(f'#!/bin/sh\n{script}\n')
    (tools / name).chmod(0o755)


def add_python(tools, version, missing='nothing'):
    """A Python that says its version and fails where a script mentions what is missing."""
    answer = f'case "$*" in *{missing}*) exit 1 ;; *version_info*) echo {version} ;; '
    add_tool(tools, f'python{version}', f'{answer} *sys.executable*) echo "$0" ;; esac')


def add_compilers(tools):
    for name in ('cc', 'c++'):
        add_tool(tools, name, 'exit 0')


def message(project, tools, **environment):
    """The one line that a failing set-up writes."""
    result = subprocess.run(
        [project / 'scripts/setup.sh'],
        env={'PATH': str(tools), 'HOME': os.environ.get('HOME', '/'), **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert result.returncode == 1
    assert result.stderr.count('\n') == 1, result.stderr
    assert not (project / '.venv').exists()
    return result.stderr


def test_no_suitable_python(project, tools):
    assert 'Python 3.10, 3.11, 3.12 or 3.13 is needed' in message(project, tools)


def test_a_wrong_python_asked_for(project, tools):
    add_python(tools, '3.9')
    assert 'python3.9' in message(project, tools, PYTHON='python3.9')


def test_no_compiler(project, tools):
    add_python(tools, '3.11')
    assert 'no C++ compiler' in message(project, tools)


def test_no_venv_module(project, tools):
    add_compilers(tools)
    add_python(tools, '3.11', missing='ensurepip')
    assert 'apt install python3.11-venv' in message(project, tools)


def test_no_headers(project, tools):
    add_compilers(tools)
    add_python(tools, '3.10', missing='Python.h')
    assert 'apt install python3.10-dev' in message(project, tools)


def test_no_room(project, tools):
    add_compilers(tools)
    add_python(tools, '3.11')
    (tools / 'df').unlink()
    add_tool(tools, 'df', 'echo head; echo disk 9000 8900 100 99% /')
    assert '100 MB are free' in message(project, tools)


def test_another_ros_is_sourced(project, tools):
    assert 'ROS 2 humble is sourced' in message(project, tools, ROS_DISTRO='humble')


PARTS = 'say machine packages pybullet'
# a pip that has no wheel, and whose builds end as BUILD says
BUILDING_PYTHON = """#!/bin/sh
case "$*" in
  *version_info*) echo 3.13 ;;
  *libc_ver*) echo glibc-2.41 ;;
  *'pip wheel'*)
    while [ "$1" != --wheel-dir ]; do shift; done
    echo built >> "$BUILDS"
    echo half > "$2/object.o"
    sleep "${BUILD_TIME:-0}"
    [ "$BUILD" = whole ] || { echo 'x.cpp:1: error: no such thing'; exit 1; }
    echo whole > "$2/pybullet-3.2.7-cp313-cp313-linux_x86_64.whl" ;;
  *--only-binary*) echo 'ERROR: No matching distribution found'; exit 1 ;;
  *'pip install'*) echo installed >> "$BUILDS" ;;
esac
"""


@pytest.fixture
def install_pybullet(project, tmp_path):
    """Runs set-up's step for PyBullet in a clone, with a pip that compiles in no time."""

    def install(build='whole', clone=project, **environment):
        python = clone / '.venv/bin/python'
        for folder in (python.parent, clone / '.venv/.stamps', clone / '.cache/setup'):
            folder.mkdir(parents=True, exist_ok=True)
        python.write_text(BUILDING_PYTHON)
        python.chmod(0o755)
        script = 'set -eu; scripts=$root/scripts; logs=$root/.cache/setup; environment_key=key; '
        script += ''.join(f'. $scripts/setup/{part}.sh; ' for part in PARTS.split())
        return subprocess.run(
            ['bash', '-c', f'{script} install_pybullet'],
            env={
                'PATH': '/usr/bin:/bin',
                'root': str(clone),
                'HOME': str(tmp_path / 'home'),
                'BUILD': build,
                'BUILDS': str(tmp_path / 'builds'),
                **environment,
            },
            capture_output=True,
            text=True,
            check=False,
        )

    return install


def test_pybullet_is_compiled_once_for_all_clones(install_pybullet, project, tmp_path):
    first = install_pybullet()
    assert 'compiling PyBullet for Python 3.13, about five minutes, once' in first.stdout
    other = tmp_path / 'other'
    shutil.copytree(project, other, ignore=shutil.ignore_patterns('.venv', '.cache'))
    second = install_pybullet(clone=other)
    assert (first.returncode, second.returncode, second.stdout) == (0, 0, '')
    assert (tmp_path / 'builds').read_text().split() == ['built', 'installed', 'installed']
    (wheel,) = (tmp_path / 'home/.cache/push_cell/wheels').rglob('*.whl')
    assert wheel.read_text() == 'whole\n'


def test_a_long_compile_says_how_far_it_is(install_pybullet):
    long = install_pybullet(BUILD_TIME='3', PROGRESS_PERIOD='1')
    assert (long.returncode, long.stderr) == (0, '')
    assert 'compiling PyBullet: 0 %' in long.stdout


def test_a_failed_compile_is_one_line_and_leaves_no_wheel(install_pybullet, tmp_path):
    failed = install_pybullet('half')
    assert failed.returncode == 1
    assert 'PyBullet does not compile: x.cpp:1: error: no such thing' in failed.stderr
    assert failed.stderr.count('\n') == 1
    assert not list(tmp_path.rglob('*.whl'))
    assert install_pybullet().returncode == 0
    assert not list(tmp_path.rglob('object.o'))


@pytest.mark.parametrize('home', ['/proc/self', '/dev/null'])
def test_a_home_that_cannot_be_written_is_done_without(install_pybullet, project, home):
    assert install_pybullet(HOME=home).returncode == 0
    assert list((project / '.cache/wheels').rglob('*.whl'))


def test_the_cache_is_where_the_user_wants_it(install_pybullet, tmp_path):
    install_pybullet(XDG_CACHE_HOME=str(tmp_path / 'caches'))
    assert list((tmp_path / 'caches/push_cell/wheels/glibc-2.41').glob('*.whl'))


@pytest.mark.parametrize(('status', 'done'), [(0, ['built']), (1, ['built', 'installed'])])
def test_uv_goes_before_pip_which_goes_on_if_uv_fails(
    install_pybullet, tools, tmp_path, status, done
):
    add_tool(tools, 'uv', f'exit {status}')
    result = install_pybullet(PATH=f'{tools}:/usr/bin:/bin')
    assert result.returncode == 0
    assert ('uv failed, pip goes on' in result.stdout) == bool(status)
    assert (tmp_path / 'builds').read_text().split() == done


@pytest.mark.parametrize('name', LOCKS)
def test_locks_pin_every_package_and_name_no_host(name):
    lines = (ROOT / f'requirements/{name}.txt').read_text().splitlines()
    for line in lines:
        assert re.match(r'( *#|[a-z0-9-]+==[^ ]+( ;|$))', line), line
        assert '://' not in line


def pinned(name):
    """The versions of each package in a lock; several where they differ by Python."""
    versions = {}
    for line in (ROOT / f'requirements/{name}.txt').read_text().splitlines():
        if match := re.match(r'([a-z0-9-]+)==([^ ]+)', line):
            versions.setdefault(match[1], set()).add(match[2])
    return versions


@pytest.mark.parametrize(('name', 'other'), [('ros', 'run'), ('dev', 'run'), ('ros', 'dev')])
def test_locks_agree_with_each_other(name, other):
    first, second = pinned(name), pinned(other)
    shared = first.keys() & second.keys()
    assert shared
    assert {p: first[p] for p in shared} == {p: second[p] for p in shared}
